// The picture of the robot above its servos: as an arm, by bones, or, where nobody described the body, its dials.

import { useRobot } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { Dials } from './Dials.tsx';
import { LiveArm } from './LiveArm.tsx';
import { LiveBones } from './LiveBones.tsx';
import { UnknownNote } from './UnknownNote.tsx';
import styles from './Body.module.css';

export function Body() {
  const isPlain = useRobot().body === 'plain';
  return (
    <div className={cx(styles.body, isPlain && styles.plain)}>
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
