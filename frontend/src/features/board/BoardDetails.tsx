// What is done with the board now and then: what the slot holds and the group becomes there, how often it runs, how fast, the map of
// the slots, erasing all. Boards cannot be read, so a slot is known only as far as this page filled it.

import { useDevice, useStores, useSlot } from '../stores.ts';
import { SlotsControl } from './slots/SlotsControl.tsx';
import { FATE_TRUTH, useFates } from './slots/useFates.ts';
import { useHeldName } from './slots/useHeldName.ts';
import { Button } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { CompileRow } from '../animate/group/CompileRow.tsx';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';
import { Absent } from './Absent.tsx';
import { EraseControl } from './EraseControl.tsx';
import { PlaceControl } from './PlaceControl.tsx';
import { RunSettings } from './RunSettings.tsx';
import { SpeedControl } from './SpeedControl.tsx';
import styles from './BoardPanel.module.css';

export function BoardDetails() {
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
      <p>{words.identity.takenFor({ name: boardName(family) })}</p>
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
  const isOther = fate === 'other' && held !== '';
  return (
    <div className={styles.row}>
      <div className={styles.about} role="status">
        <Chip truth={FATE_TRUTH[fate]}>{words.board.glance({ slot, badge: words.slots.badge[fate] })}</Chip>
        <p>{isOther ? words.slots.holdsNamed({ name: held }) : words.slots.holds[fate]}</p>
      </div>
      <PlaceControl />
    </div>
  );
}
