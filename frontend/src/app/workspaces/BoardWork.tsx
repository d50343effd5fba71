// The workspace Board on a wide screen: the slots and what is done with them, the battery, and the log of packets.

import { BatteryPanel } from '../../features/battery/BatteryPanel.tsx';
import { BoardPanel } from '../../features/board/BoardPanel.tsx';
import { CompileRow } from '../../features/animate/group/CompileRow.tsx';
import { LogPanel } from '../../features/log/LogPanel.tsx';
import { useView } from '../../features/stores.ts';
import panel from '../../ui/Panel.module.css';
import { useLayout } from '../../ui/useLayout.ts';
import { Split, sized } from './parts.tsx';
import styles from './Workspaces.module.css';

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
