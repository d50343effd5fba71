// The picture of the robot above its servos: as an arm, by bones, or, where nobody described the body, its dials.

import { useRef } from 'react';
import { select } from '../stores/servoView.ts';
import { editServoView, useDevice, useRobot, useServoView, useStores } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { Dial, drawPreviews } from './Dial.tsx';
import { LiveArm } from './LiveArm.tsx';
import { LiveBones } from './LiveBones.tsx';
import { UnknownNote } from './UnknownNote.tsx';
import { usePreview } from './usePreview.ts';
import { words } from '../words/words.ts';
import styles from './Body.module.css';

export function Body() {
  return (
    <div className={styles.body}>
      <BodyPicture />
      <UnknownNote />
    </div>
  );
}

export function BodyPicture() {
  const { body } = useRobot();
  if (body === 'arm') return <LiveArm />;
  if (body === 'plain') return <Dials />;
  return (
    <div className={styles.bones}>
      <LiveBones />
    </div>
  );
}

/** Large enough to read across the room. */
function Dials() {
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const selected = useServoView((view) => view.selected);
  const { servos } = useRobot();
  const dials = useRef<HTMLOListElement>(null);
  usePreview((pose) => dials.current !== null && drawPreviews(dials.current, pose, family));
  return (
    <ol ref={dials} className={styles.dials}>
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
