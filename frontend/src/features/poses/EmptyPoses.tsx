// Where there is no pose yet: how some would look, on the robot at hand.

import { useDevice, useRobot } from '../stores.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import { EmptyState } from '../../ui/EmptyState.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './EmptyPoses.module.css';

export function EmptyPoses() {
  return <EmptyState title={words.poses.empty} hint={words.poses.emptyHint} sketch={<Sketch />} />;
}

/** How far each servo is from home, of the way to its limit. */
const SHARES = [-0.4, 0, 0.4];

function Sketch() {
  const { servos } = useRobot();
  const family = useDevice((state) => state.family);
  return (
    <div className={styles.sketch} aria-hidden="true">
      {SHARES.map((share) => (
        <span key={share} className={styles.card}>
          <PoseThumb
            pose={new Map(servos.map((one) => [one.servo, turned(one, share)]))}
            changed={[]}
            family={family}
          />
        </span>
      ))}
    </div>
  );
}

function turned({ home, min, max }: Record<'home' | 'min' | 'max', number>, share: number): number {
  return Math.round(home + share * (share < 0 ? home - min : max - home));
}
