// The picture of the robot above its servos: as an arm, by bones, or, where nobody described the body, its dials.

import { select } from '../stores/servoView.ts';
import { editServoView, useDevice, useRobot, useServoView, useStores } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { Dial } from './Dial.tsx';
import { LiveArm } from './LiveArm.tsx';
import { LiveBones } from './LiveBones.tsx';
import { UnknownNote } from './UnknownNote.tsx';
import { words } from '../words/words.ts';
import styles from './Body.module.css';

export function Body() {
  const { body } = useRobot();
  return (
    <div className={styles.body}>
      {body === 'arm' && <LiveArm />}
      {body === 'plain' && <Dials />}
      {body !== 'arm' && body !== 'plain' && (
        <div className={styles.bones}>
          <LiveBones />
        </div>
      )}
      <UnknownNote />
    </div>
  );
}

/** Large enough to read across the room. */
function Dials() {
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const selected = useServoView((view) => view.selected);
  const { servos } = useRobot();
  return (
    <ol className={styles.dials}>
      {servos.map(({ servo }) => (
        <li
          key={servo}
          className={cx(styles.dial, selected.includes(servo) && styles.selected)}
          onPointerDown={() => editServoView(stores, (view) => select(view, [servo]))}
        >
          <Dial servo={servo} family={family} />
          {words.numbers.formatWhole(servo)}
        </li>
      ))}
    </ol>
  );
}
