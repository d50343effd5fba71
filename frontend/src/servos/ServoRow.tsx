// One servo: dial, name, slider, value. The target comes from the row's own number in the device store; the estimate is
// drawn once a frame past React, so that a moving servo costs nothing elsewhere.

import { memo } from 'react';
import type { RobotServo } from '#shared/actions/robot.ts';
import { Dial } from '../body/Dial.tsx';
import { motionHindrance, tellsPositions } from '../stores/readiness.ts';
import { useDevice, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { NumberField } from '../ui/NumberField.tsx';
import { words } from '../words/en.ts';
import { Estimate } from './Estimate.tsx';
import { PositionSlider } from './PositionSlider.tsx';
import { positionStep } from './positionStep.ts';
import { Reported } from './Reported.tsx';
import styles from './ServoRow.module.css';

export const ServoRow = memo(function ServoRow({ servo: own }: { readonly servo: RobotServo }) {
  const { servo, name: joint, min, max } = own;
  const { device, view, notices } = useStores();
  const family = useDevice((state) => state.family);
  const target = useDevice((state) => state.targets[servo] ?? null);
  const moveTime = useView((state) => state.moveTime);
  const isSelected = useView((state) => state.selectedServo === servo);
  const blocked = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const isTelling = tellsPositions(family);
  const name = words.servos.name(servo);
  const move = (position: number): void => device.move([{ servo, position }], moveTime);

  return (
    <li
      className={cx(styles.row, isTelling && styles.telling, isSelected && styles.selected)}
      onFocus={() => view.setState({ selectedServo: servo })}
    >
      <Dial servo={servo} family={family} />
      <span className={styles.name}>
        {name}
        <span className={styles.joint}>{joint === name ? '' : joint}</span>
      </span>
      <PositionSlider servo={own} family={family} target={target} blocked={blocked} onMove={move} />
      <NumberField
        label={words.servos.target(servo)}
        size="large"
        value={target}
        min={min}
        max={max}
        step={positionStep(family)}
        unit={words.servos.unit(family.unit)}
        placeholder={words.servos.unknown}
        isReadOnly={blocked}
        onChange={move}
        onRefused={(value) => notices.tell('warning', words.refused(name, value, min, max))}
      />
      <div className={styles.readings}>
        <Estimate servo={servo} />
        {isTelling && <Reported servo={servo} />}
      </div>
    </li>
  );
});
