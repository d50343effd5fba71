// A servo's dial and name as one button that selects it: alone, added with Ctrl or by touch, as a range with Shift.

import type { Ref } from 'react';
import type { RobotServo } from '#shared/profile/robot.ts';
import { Dial } from '../picture/Dial.tsx';
import { isHeld, selectByClick } from '../servoView.ts';
import { editServoView, useDevice, useServoView, useStores } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { selectHow } from '../../ui/inputEvents.ts';
import { numberAndName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import styles from './ServoName.module.css';

export interface ServoNameProps {
  readonly ref: Ref<HTMLButtonElement>;
  readonly servo: RobotServo;
  readonly order: readonly number[];
}

export function ServoName({ ref, servo: own, order }: ServoNameProps) {
  const { servo, name: joint, isReversed } = own;
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  const isLocked = useServoView((view) => isHeld(view, servo));
  const name = words.servos.name({ servo });

  const said = [
    ...(isReversed ? [words.servoPanel.marks.reversed] : []),
    ...(isLocked ? [words.servoPanel.marks.locked] : []),
  ];
  return (
    <button
      ref={ref}
      type="button"
      className={styles.name}
      aria-pressed={isSelected}
      aria-label={[numberAndName(servo, joint), ...said].join(words.comma)}
      onClick={(event) =>
        editServoView(stores, (view) => selectByClick(view, servo, selectHow(event), order))
      }
    >
      <Dial servo={servo} family={family} />
      <span className={styles.texts}>
        <span className={styles.joint}>{joint || name}</span>
        <span className={styles.number}>
          {isReversed && <Icon name="reverse" />}
          {isLocked && <Icon name="lock" />}
          {joint && joint !== name && name}
        </span>
      </span>
    </button>
  );
}
