// Two workspaces of a wide screen that have the board's panels: Animate, with the timeline, its frames and the sliders beside or the robot
// above them; and Board, with the battery and the log of packets.

import { Authoring } from '../Authoring.tsx';
import { LivePanel, Split, sized } from './parts.tsx';
import { CompileRow } from '../../features/animate/group/CompileRow.tsx';
import { BatteryPanel } from '../../features/battery/BatteryPanel.tsx';
import { BoardPanel } from '../../features/board/BoardPanel.tsx';
import { RobotPanel } from '../../features/drive/RobotPanel.tsx';
import { useIsUnidentified, useView } from '../../features/stores.ts';
import { cx } from '../../ui/cx.ts';
import { useLayout } from '../../ui/useLayout.ts';
import styles from './Workspaces.module.css';
import { LogPanel } from '../../features/log/LogPanel.tsx';
import panel from '../../ui/Panel.module.css';

const SIDE = { min: 400, max: 720 };
/** As Workspaces.module.css has it. */
const usualSide = (): number => Math.round(Math.min(560, Math.max(500, innerWidth * 0.362)));
const ABOVE = { min: 120, max: 640 };
/** Likewise. */
const usualAbove = (): number => Math.round(Math.min(320, Math.max(160, innerHeight * 0.24)));

export function AnimateWork() {
  const isDesktop = useLayout() === 'desktop';
  const splits = useView((state) => state.splits);
  const isWanted = useView(({ animateWith }) => animateWith === 'robot');
  // Which board it is has to be chosen first.
  const isFull = !useIsUnidentified() && isDesktop && isWanted;
  return (
    <main
      className={cx(styles.animate, isFull && styles.full)}
      style={isFull ? sized('--above', splits.animateAbove) : sized('--side', splits.animateSide)}
    >
      {isFull ? (
        <>
          <div className={styles.robot}>
            <RobotPanel isPreview />
          </div>
          <Split name="animateAbove" between="rows" isBefore usual={usualAbove()} {...ABOVE} />
        </>
      ) : (
        <>
          <div className={styles.side}>
            <LivePanel />
          </div>
          {isDesktop && <Split name="animateSide" between="columns" isBefore usual={usualSide()} {...SIDE} />}
        </>
      )}
      <div className={styles.authoring} data-column>
        <div className={styles.work}>
          <Authoring />
        </div>
        <div className={styles.boardRow}>
          <BoardPanel isSpread fit={<CompileRow />} />
          <BatteryPanel />
        </div>
      </div>
    </main>
  );
}

const LOG = { usual: 320, min: 160, max: 720 };

export function BoardWork() {
  const isDesktop = useLayout() === 'desktop';
  const splits = useView((state) => state.splits);
  return (
    <main className={styles.board} style={sized('--log', splits.boardLog)}>
      <div className={styles.boardParts}>
        <BoardPanel fit={<CompileRow />} />
        <BatteryPanel />
      </div>
      {isDesktop && <Split name="boardLog" between="rows" {...LOG} />}
      <div className={`${panel.panel} ${styles.log}`}>
        <LogPanel />
      </div>
    </main>
  );
}
