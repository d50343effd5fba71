// Turns the servo a little and back, and asks whether that was the way of the arrow. Whichever side of home has more room is
// tried, and the arrow says that side.

import { useState } from 'react';
import type { Frame } from '#shared/protocol/commands.ts';
import { changeServo } from '#shared/actions/robot/robotEdits.ts';
import type { RobotServo } from '#shared/actions/robot/robot.ts';
import { useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import type { CalibrationAtHand } from './useCalibration.ts';
import styles from './CalibrationWizard.module.css';

export function DirectionStep({ at: { servo, accept } }: { readonly at: CalibrationAtHand }) {
  const { device } = useStores();
  const [hasTurned, setTurned] = useState(false);
  const isIdle = useSnapshot(({ activity }) => activity.kind === 'idle');
  const answer = (isReversed: boolean) => () =>
    accept((robot) => changeServo(robot, servo.servo, { isReversed }));
  return (
    <>
      <p>{words.calibration.direction}</p>
      <TurnArrow isClockwise={sideOf(servo) > 0} />
      <Button
        tone={hasTurned ? 'plain' : 'primary'}
        isDisabled={!isIdle}
        onPress={() => device.play(turnAndBack(servo), 1, (isDone) => isDone && setTurned(true))}
      >
        {words.calibration.turn}
      </Button>
      <p>{hasTurned ? words.calibration.asked : ''}</p>
      <div className={styles.actions}>
        <Button tone={hasTurned ? 'primary' : 'plain'} isDisabled={!hasTurned} onPress={answer(false)}>
          {words.calibration.same}
        </Button>
        <Button isDisabled={!hasTurned} onPress={answer(true)}>
          {words.calibration.other}
        </Button>
      </div>
    </>
  );
}

const sideOf = ({ min, home, max }: RobotServo): 1 | -1 => (max - home >= home - min ? 1 : -1);

const TURN_MS = 900;
const SHARE_OF_SIDE = 0.3;

/** Home first: the servo may stand anywhere. */
function turnAndBack(servo: RobotServo): readonly Frame[] {
  const side = sideOf(servo) > 0 ? servo.max - servo.home : servo.min - servo.home;
  const away = Math.round(servo.home + side * SHARE_OF_SIDE);
  return [servo.home, away, servo.home].map((position) => ({
    durationMs: TURN_MS,
    targets: [{ servo: servo.servo, position }],
  }));
}

/** A horn and the way it turns; drawn the other way round it turns the other way. */
function TurnArrow({ isClockwise }: { readonly isClockwise: boolean }) {
  return (
    <svg className={styles.arrow} viewBox="-60 -60 120 76" role="img" aria-label={words.calibration.arrow}>
      <g transform={isClockwise ? '' : 'scale(-1 1)'}>
        <path className={styles.horn} d="M-9 0L-4 -40a4 4 0 0 1 8 0L9 0A9 9 0 0 1 -9 0z" />
        <path className={styles.turn} d="M-36 -36A51 51 0 0 1 34 -38M34 -38l-4 -14M34 -38l-14 1" />
      </g>
    </svg>
  );
}
