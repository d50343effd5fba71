// Where the board says that a servo stands, and how long ago it said so: the one figure here that nobody computed.

import { fromBoard } from '#shared/profile/robot.ts';
import { useRobot, useSnapshot, useStores } from '../stores.ts';
import { Chip } from '../../ui/Chip.tsx';
import { useNow } from '../../ui/useNow.ts';
import { words } from '../../i18n/words.ts';
import type { Scale } from './scale.ts';
import styles from './Reported.module.css';

const AGE_REFRESH_MS = 1000;

export function Reported({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const robot = useRobot();
  const reading = useSnapshot((snapshot) => snapshot.reported[servo]);
  const nowMs = useNow(device.clock.now, AGE_REFRESH_MS);
  if (reading === undefined) return null;
  return (
    <span className={styles.reported} role="group" title={words.truth.confirmed}>
      <Chip truth="confirmed">{scale.digits(fromBoard(robot, servo, reading.position))}</Chip>
      <span className={styles.age}>{words.numbers.formatAge(nowMs - reading.atMs)}</span>
    </span>
  );
}
