// What lives on the board: slots, downloading to one, running one, erasing all. Boards cannot be read, so a slot is known
// only as far as this page filled it.

import { useDevice, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { SlotsControl } from '../slots/SlotsControl.tsx';
import { Chip } from '../ui/Chip.tsx';
import { NumberField } from '../ui/NumberField.tsx';
import { Panel } from '../ui/Panel.tsx';
import { CompileRow } from '../compile/CompileRow.tsx';
import { words } from '../words/words.ts';
import { Absent } from './Absent.tsx';
import { DownloadControl } from './DownloadControl.tsx';
import { EraseControl } from './EraseControl.tsx';
import { PlaceControl } from './PlaceControl.tsx';
import { RunControl } from './RunControl.tsx';
import { SpeedControl } from './SpeedControl.tsx';
import styles from './BoardPanel.module.css';

export function BoardPanel() {
  const { commands, id } = useDevice((state) => state.family);
  const why = id === 'unknown' ? words.board.unsure : words.board.absent;
  const canErase = commands.includes('erase');
  return (
    <Panel
      title={words.board.title}
      tools={
        <>
          <SlotsControl />
          {canErase && <EraseControl />}
        </>
      }
    >
      <div className={styles.rows}>
        <SlotControl />
        <CompileRow />
        {commands.includes('download') ? (
          <DownloadControl />
        ) : (
          <Absent what={words.board.download} why={why.download} />
        )}
        {commands.includes('run') ? <RunControl /> : <Absent what={words.board.run} why={why.run} />}
        {commands.includes('setSpeed') ? (
          <SpeedControl />
        ) : (
          <Absent what={words.board.speed} why={why.speed} />
        )}
        {!canErase && <Absent what={words.board.erase} why={why.erase} />}
      </div>
    </Panel>
  );
}

function SlotControl() {
  const { view, notices } = useStores();
  const slot = useView((state) => state.slot);
  const { min, max } = useDevice((state) => state.family.slot);
  const fate = useSnapshot(({ brokenSlots, storedSlots }) =>
    brokenSlots.includes(slot) ? 'broken' : storedSlots.includes(slot) ? 'stored' : 'unknown',
  );
  return (
    <div className={styles.row}>
      <div className={styles.field}>
        <span className={styles.label} aria-hidden="true">
          {words.board.slot}
        </span>
        <NumberField
          label={words.board.slot}
          value={slot}
          min={min}
          max={max}
          onChange={(value) => view.setState({ slot: value })}
          onRefused={(value) => notices.tell('warning', words.refused(words.board.slot, value, min, max))}
        />
      </div>
      <div>
        <div className={styles.about} role="status">
          <Chip truth={FATE_TRUTH[fate]}>{words.board.slotBadge[fate]}</Chip>
          <p>{words.board.slotAbout[fate]}</p>
        </div>
        <PlaceControl />
      </div>
    </div>
  );
}

const FATE_TRUTH = { broken: 'danger', stored: 'confirmed', unknown: 'unknown' } as const;
