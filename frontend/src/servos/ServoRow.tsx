// One servo: dial, name, slider, value. The target comes from the row's own number in the device store; the estimate is
// drawn once a frame past React, so that a moving servo costs nothing elsewhere.

import { memo, useRef } from 'react';
import type { RobotServo } from '#shared/actions/robot/robot.ts';
import { motionHindrance, tellsPositions } from '../stores/readiness.ts';
import { isHeld } from '../stores/servoView.ts';
import { useDevice, useGuess, useServoView, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { NumberField } from '../ui/NumberField.tsx';
import { useWords, words } from '../words/words.ts';
import { Estimate } from './Estimate.tsx';
import { PositionSlider } from './PositionSlider.tsx';
import { Reported } from './Reported.tsx';
import { scaleOf, stepped } from './scale.ts';
import { ServoName } from './ServoName.tsx';
import { useHand } from './useHand.ts';
import { useWheelSteps } from './useWheelSteps.ts';
import styles from './ServoRow.module.css';

export interface ServoRowProps {
  readonly servo: RobotServo;
  /** All servos of the list from top to bottom, for selecting a stretch of it. */
  readonly order: readonly number[];
}

export const ServoRow = memo(function ServoRow({ servo: own, order }: ServoRowProps) {
  const { servo } = own;
  useWords();
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  return (
    <li className={cx(styles.row, isSelected && styles.selected)}>
      <ServoName servo={own} order={order} />
      <ServoControls servo={own} />
    </li>
  );
});

export function ServoControls({ servo: own }: { readonly servo: RobotServo }) {
  const { servo } = own;
  const { device, notices } = useStores();
  const hand = useHand();
  const family = useDevice((state) => state.family);
  const target = useDevice((state) => state.targets[servo] ?? null);
  const guess = useGuess(own);
  const scale = scaleOf(
    own,
    family,
    useView((state) => state.positionsIn),
  );
  const hindrance = useSnapshot(motionHindrance);
  const isLocked = useServoView((view) => isHeld(view, servo));
  const isTelling = tellsPositions(family);
  const blocked = hindrance !== null || isLocked;
  const move = (position: number): void => hand.move(servo, position);

  const area = useRef<HTMLDivElement>(null);
  useWheelSteps(area, (change, isFar) => {
    if (!blocked) move(stepped(scale, target ?? guess ?? own.home, change * (isFar ? 10 : 1)));
  });

  return (
    <div
      ref={area}
      className={cx(styles.controls, isTelling && styles.telling)}
      onPointerDown={hindrance === 'watching' ? () => device.lease('request') : undefined}
    >
      <PositionSlider
        {...{ servo: own, family, scale, target, guess, blocked }}
        onMove={move}
        onDrag={(position) => hand.drag(servo, position)}
        onHome={() => hand.home([servo])}
      />
      <NumberField
        label={words.servos.target(servo)}
        size="large"
        value={target === null ? null : scale.shown(target)}
        {...{ min: scale.min, max: scale.max, unit: scale.unit, decimals: scale.decimals }}
        placeholder={guess === null ? words.servos.unknown : words.firstMoves.guessed(scale.digits(guess))}
        start={scale.shown(guess ?? own.home)}
        isReadOnly={blocked}
        onChange={(shown) => move(scale.position(shown))}
        onRefused={(shown) => notices.tell('warning', refusal(own, shown, scale))}
      />
      <div className={styles.readings}>
        <Estimate servo={servo} scale={scale} />
        {isTelling && <Reported servo={servo} scale={scale} />}
      </div>
    </div>
  );
}

function refusal({ servo, name }: RobotServo, shown: number, { min, max, unit }: ReturnType<typeof scaleOf>) {
  const text = (value: number): string => (unit === '°' ? `${value}°` : `${value}`);
  return words.servoPanel.refused(name || words.servos.name(servo), text(shown), text(min), text(max));
}
