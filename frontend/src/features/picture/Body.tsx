// The picture of the robot above its servos: as an arm, by bones, or, where nobody described the body, its dials.

import { useRobot } from '../stores.ts';
import { cx } from '../../ui/cx.ts';
import { Dials } from './Dials.tsx';
import { LiveArm, LiveBones } from './pictures.ts';
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
  if (body === 'plain') return <Dials />;
  return body === 'arm' ? (
    <div className={styles.arm}>
      <LiveArm />
    </div>
  ) : (
    <div className={styles.bones}>
      <LiveBones />
    </div>
  );
}
