// What lives on the board: slots, downloading to one, running one, erasing all. Boards cannot be read, so a slot is known
// only as far as this page filled it.

import { recordOf } from '#shared/actions/slots/slotBook.ts';
import { obstacles } from '../stores/compiled.ts';
import { useCompiled, useDevice, useSlots, useStores, useView } from '../stores/stores.ts';
import { SlotsControl } from '../slots/SlotsControl.tsx';
import { FATE_TRUTH, useFates } from '../slots/useFates.ts';
import { Button } from '../ui/Button.tsx';
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
import field from '../ui/Field.module.css';
import styles from './BoardPanel.module.css';

export function BoardPanel() {
  const { commands, id } = useDevice((state) => state.family);
  const why = id === 'unknown' ? words.board.unsure : words.board.absent;
  const canErase = commands.includes('erase');
  return (
    <Panel
      title={words.board.title}
      note={<AtAGlance />}
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
        <TakenFor />
      </div>
    </Panel>
  );
}

/** Which board this is taken for, and the way to another one. */
function TakenFor() {
  const { view } = useStores();
  const family = useDevice((state) => state.family);
  return (
    <div className={styles.takenFor}>
      <p>{words.identity.takenFor(words.boardName(family))}</p>
      <Button tone="quiet" icon="plug" onPress={() => view.setState({ connectOpen: true })}>
        {words.identity.change}
      </Button>
    </div>
  );
}

/** What stands below in full, for a window in which only the head of this panel is in sight. */
function AtAGlance() {
  const slot = useView((state) => state.slot);
  const fate = useFates()(slot);
  const { frames, report } = useCompiled((state) => state.latest);
  const fits = obstacles(report, 'board').length === 0;
  return (
    <span className={styles.glance} aria-hidden="true">
      <Chip truth={FATE_TRUTH[fate]}>{words.board.glance(slot, words.slots.badge[fate])}</Chip>
      {frames.length > 0 && (
        <Chip truth={fits ? 'confirmed' : 'danger'}>{fits ? words.compile.fits : words.compile.fitsNot}</Chip>
      )}
    </span>
  );
}

function SlotControl() {
  const { view, notices } = useStores();
  const slot = useView((state) => state.slot);
  const { min, max } = useDevice((state) => state.family.slot);
  const fate = useFates()(slot);
  const held = useSlots(({ book }) => recordOf(book, slot)?.name ?? '');
  return (
    <div className={styles.row}>
      <div className={field.named}>
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
          <Chip truth={FATE_TRUTH[fate]}>{words.slots.badge[fate]}</Chip>
          <p>{words.slots.holds(fate, held)}</p>
        </div>
        <PlaceControl />
      </div>
    </div>
  );
}
