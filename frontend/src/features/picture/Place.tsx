// A servo on the body: its dial and number, pressed to select it.

import type { CSSProperties } from 'react';
import type { RobotServo } from '#shared/profile/robot.ts';
import { isHeld, selectByClick } from '../drive/servoView.ts';
import { editServoView, useDevice, useServoView, useStores } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { selectHow } from '../../ui/selectHow.ts';
import { numberAndName } from '../../i18n/sentences/servos.ts';
import { words } from '../../i18n/words.ts';
import { Dial } from './Dial.tsx';
import styles from './Place.module.css';

/** With more servos than this their names lie over each other. */
const MOST_CALLED = 8;

export interface PlaceProps {
  readonly servo: RobotServo;
  readonly order: readonly number[];
}

export function Place({ servo: own, order }: PlaceProps) {
  const { servo, name, place } = own;
  const stores = useStores();
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  const isLocked = useServoView((view) => isHeld(view, servo));
  const marks = isLocked ? [words.servoPanel.marks.locked] : [];
  return (
    <li className={styles.place} style={at(place)}>
      <button
        type="button"
        className={styles.button}
        aria-pressed={isSelected}
        aria-label={[numberAndName(servo, name), ...marks].join(words.comma)}
        onClick={(event) =>
          editServoView(stores, (view) => selectByClick(view, servo, selectHow(event), order))
        }
      >
        <PlaceFace servo={servo} isLocked={isLocked} />
        {order.length <= MOST_CALLED && (
          <span className={styles.called} aria-hidden="true">
            {name}
          </span>
        )}
      </button>
    </li>
  );
}

export function PlaceFace({ servo, isLocked = false }: { servo: number; isLocked?: boolean }) {
  const family = useDevice((state) => state.family);
  return (
    <>
      <Dial servo={servo} family={family} />
      <span className={styles.number}>
        {words.numbers.formatWhole(servo)}
        {isLocked && <Icon name="lock" />}
      </span>
    </>
  );
}

export const at = ({ x, y }: RobotServo['place']): CSSProperties => ({ left: `${x}%`, top: `${y}%` });
