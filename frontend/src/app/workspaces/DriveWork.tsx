// The workspace Drive on a wide screen: the robot large, its sliders beside it, and below it the poses or the keys and the pad.

import { BelowRobot } from '../Authoring.tsx';
import { LivePanel, Split, sized } from './parts.tsx';
import { RobotPanel } from '../../features/drive/RobotPanel.tsx';
import { useView } from '../../features/stores.ts';
import { useLayout } from '../../ui/useLayout.ts';
import { laterComponent } from '../../ui/later.tsx';
import styles from './Workspaces.module.css';

const TryMotion = laterComponent(async () => (await import('./TryMotion.tsx')).TryMotion, '0');

const SIDE = { usual: 440, min: 360, max: 720 };
const BELOW = { usual: 280, min: 160, max: 560 };

export function DriveWork() {
  const isDesktop = useLayout() === 'desktop';
  const splits = useView((state) => state.splits);
  const isBelowOpen = useView((state) => state.driveBelow !== 'none');
  return (
    <main className={styles.drive} style={sized('--side', splits.driveSide)}>
      <div className={styles.robot}>
        <RobotPanel>
          <TryMotion />
        </RobotPanel>
        {isBelowOpen && isDesktop ? (
          <Split name="driveBelow" between="rows" {...BELOW} />
        ) : (
          <div className={styles.gap} />
        )}
        <div className={styles.below} data-open={isBelowOpen} style={sized('--below', splits.driveBelow)}>
          <BelowRobot />
        </div>
      </div>
      {isDesktop && <Split name="driveSide" between="columns" {...SIDE} />}
      <div className={styles.side}>
        <LivePanel isBesideRobot />
      </div>
    </main>
  );
}
