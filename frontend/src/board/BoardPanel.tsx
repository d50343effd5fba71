// What lives on the board: the strip of what is done with it again and again, and below it the details: what the slot holds and
// the group becomes there, how often it runs, how fast, the map of the slots, erasing all. Boards cannot be read, so a slot is
// known only as far as this page filled it.

import { useId, useRef, type RefObject } from 'react';
import { useDevice, useStores, useSlot } from '../stores/stores.ts';
import { SlotsControl } from '../slots/SlotsControl.tsx';
import { FATE_TRUTH, useFates } from '../slots/useFates.ts';
import { useHeldName } from '../slots/useHeldName.ts';
import { Button } from '../ui/Button.tsx';
import { Chip } from '../ui/Chip.tsx';
import { CompileRow } from '../compile/CompileRow.tsx';
import { words } from '../words/words.ts';
import { Absent } from './Absent.tsx';
import { BoardStrip } from './BoardStrip.tsx';
import { EraseControl } from './EraseControl.tsx';
import { PlaceControl } from './PlaceControl.tsx';
import { RunSettings } from './RunSettings.tsx';
import { SpeedControl } from './SpeedControl.tsx';
import panel from '../ui/Panel.module.css';
import { PART } from '../ui/useParts.ts';
import styles from './BoardPanel.module.css';

export interface BoardPanelProps {
  /** Its two parts stand in the column around it, as wide as that: the strip stays in sight, the details scroll. */
  readonly isSpread?: boolean;
}

export function BoardPanel({ isSpread = false }: BoardPanelProps) {
  const titleId = useId();
  const details = useRef<HTMLDivElement>(null);
  return (
    <section {...PART} className={isSpread ? styles.spread : panel.panel} aria-labelledby={titleId}>
      <header className={styles.strip}>
        <h2 id={titleId} className={panel.title}>
          {words.board.title}
        </h2>
        <BoardStrip />
        {isSpread && <DetailsButton details={details} />}
      </header>
      <div ref={details} className={styles.rows}>
        <Details />
      </div>
    </section>
  );
}

/** There and back again. */
function DetailsButton({ details }: { readonly details: RefObject<HTMLElement | null> }) {
  const turn = (): void => {
    const column = details.current?.closest('[data-column]');
    const isThere = (column?.scrollTop ?? 0) > 0;
    if (isThere) column?.scrollTo({ top: 0 });
    else details.current?.scrollIntoView({ block: 'end' });
  };
  return (
    <span className={styles.turn}>
      <Button tone="quiet" icon="down" onPress={turn}>
        {words.board.details}
      </Button>
    </span>
  );
}

function Details() {
  const { commands, id } = useDevice((state) => state.family);
  const why = id === 'unknown' ? words.board.unsure : words.board.absent;
  const canErase = commands.includes('erase');
  return (
    <>
      <HeldRow />
      <CompileRow />
      {!commands.includes('download') && <Absent what={words.board.download} why={why.download} />}
      {commands.includes('run') ? <RunSettings /> : <Absent what={words.board.run} why={why.run} />}
      {commands.includes('setSpeed') ? <SpeedControl /> : <Absent what={words.board.speed} why={why.speed} />}
      {!canErase && <Absent what={words.board.erase} why={why.erase} />}
      <div className={styles.foot}>
        <SlotsControl />
        {canErase && <EraseControl />}
        <TakenFor />
      </div>
    </>
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

function HeldRow() {
  const slot = useSlot();
  const fate = useFates()(slot);
  const held = useHeldName()(slot) ?? '';
  return (
    <div className={styles.row}>
      <div className={styles.about} role="status">
        <Chip truth={FATE_TRUTH[fate]}>{words.board.glance(slot, words.slots.badge[fate])}</Chip>
        <p>{words.slots.holds(fate, held)}</p>
      </div>
      <PlaceControl />
    </div>
  );
}
