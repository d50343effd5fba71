// Lists the servos with an unknown position before and during their first move, and offers to move them to their last known positions.
// Reserves its line when all positions are known.

import type { Robot } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { DeviceState } from '../../robot/device.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { freeOf } from '../servoView.ts';
import {
  guessesNow,
  useDevice,
  useIsGuessing,
  useRobot,
  useSnapshot,
  useStores,
  type Stores,
} from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { servosText, waitingSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import styles from './UnknownNote.module.css';

export function UnknownNote() {
  const robot = useRobot();
  // Neither moved nor reported.
  const text = useDevice(({ known, snapshot }) =>
    snapshot.waitingToStart.length > 0
      ? waitingSentence(snapshot.waitingToStart)
      : textOf(unknownOf(robot, known), robot.servos.length),
  );
  const isOffered = useIsGuessing();
  return (
    <div className={styles.note}>
      <p aria-live="polite">{text}</p>
      {isOffered && <GoToGuess />}
    </div>
  );
}

function GoToGuess() {
  const stores = useStores();
  const isDisabled = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  return (
    <Button
      hint={words.firstMoves.goToGuessHint}
      isDisabled={isDisabled}
      onPress={() => stores.device.move(guessed(stores), GENTLE_MOVE_MS)}
    >
      {words.firstMoves.goToGuess}
    </Button>
  );
}

function guessed(stores: Stores): readonly ServoTarget[] {
  const guesses = Object.entries(guessesNow(stores));
  return freeOf(
    stores,
    guesses.map(([servo, position]) => ({ servo: Number(servo), position })),
  );
}

function unknownOf({ servos }: Robot, known: DeviceState['known']): readonly number[] {
  return servos.map(({ servo }) => servo).filter((servo) => !known.includes(servo));
}

function textOf(unknown: readonly number[], count: number): string {
  if (unknown.length === 0) return '';
  return unknown.length === count
    ? words.body.allUnknown
    : words.servoPanel.someUnknown({ servos: servosText(unknown) });
}
