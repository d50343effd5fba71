// The workspace Animate on a wide screen: the timeline and its frames, the sliders beside them, and below, in one scroll, what is done with
// the board.

import { Authoring } from '../Authoring.tsx';
import { LivePanel, Split, sized } from './parts.tsx';
import { CompileRow } from '../../features/animate/group/CompileRow.tsx';
import { BatteryPanel } from '../../features/battery/BatteryPanel.tsx';
import { BoardPanel } from '../../features/board/BoardPanel.tsx';
import { useView } from '../../features/stores.ts';
import { useLayout } from '../../ui/useLayout.ts';
import styles from './Workspaces.module.css';

const SIDE = { min: 400, max: 720 };
/** As Workspaces.module.css has it. */
const usualSide = (): number => Math.round(Math.min(560, Math.max(500, innerWidth * 0.362)));

export function AnimateWork() {
  const isDesktop = useLayout() === 'desktop';
  const splits = useView((state) => state.splits);
  return (
    <main className={styles.animate} style={sized('--side', splits.animateSide)}>
      <div className={styles.side}>
        <LivePanel />
      </div>
      {isDesktop && <Split name="animateSide" between="columns" isBefore usual={usualSide()} {...SIDE} />}
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
