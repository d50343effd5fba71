// The less frequent controls of the board: content of the slot, settings of runs, speed, the map of slots, erasing. Slots cannot be
// read back from a board, so their contents are known only from downloads.

import { useState, type ReactNode } from 'react';
import { setMeta } from '#shared/group/groupEdits.ts';
import { notRestored } from '#shared/group/slotBook.ts';
import { Button } from '../../ui/Button.tsx';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/whole.ts';
import { chosenTimes } from './slots/groupPlace.ts';
import {
  useDocument,
  useHoldsMotion,
  useSlot,
  useStores,
  useView,
  useDevice,
  useSlots,
  useSnapshot,
} from '../stores.ts';
import { startHindrance, motionHindrance } from '../../robot/readiness.ts';
import { Confirm } from '../../ui/Confirm.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { CONTENT_TRUTH, useSlotContents, useHeldName } from './slots/slotHooks.ts';
import { Chip } from '../../ui/Chip.tsx';
import { boardName } from '../../i18n/sentences.ts';
import { RunSettings } from './DownloadAndRun.tsx';
import styles from './BoardPanel.module.css';
import field from '../../ui/Field.module.css';

const SlotBoard = laterComponent(async () => (await import('./slots/SlotBoard.tsx')).SlotBoard, '60vh');

function SlotsControl() {
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      <Button tone="quiet" icon="buttons" onPress={() => setOpen(true)}>
        {words.slots.open}
      </Button>
      <Dialog
        full
        title={words.slots.title}
        closeLabel={words.close}
        isOpen={isOpen}
        onClose={() => setOpen(false)}
      >
        <SlotBoard />
      </Dialog>
    </>
  );
}

interface AbsentProps {
  readonly what: string;
  readonly why: string;
}

/** In place of a control whose command this board lacks: what is missing, and what to do instead. */
function Absent({ what, why }: AbsentProps) {
  return (
    <div className={styles.row}>
      <span className={styles.label}>{what}</span>
      <p className={styles.absent}>{why}</p>
    </div>
  );
}

/** The slot and the number of repetitions that are stored in the open group; the choices above can be stored in it. */
function PlaceControl() {
  const { document, view } = useStores();
  const slot = useDocument(({ present }) => present.slot);
  const times = useDocument(({ present }) => present.times);
  const isEmpty = !useHoldsMotion();
  const chosenSlot = useSlot();
  const isUnchanged = useView((state) => chosenTimes(state) === times) && chosenSlot === slot;
  const keep = (): void =>
    document.edit(
      () => words.board.steps.place,
      (group) => setMeta(group, { slot: chosenSlot, times: chosenTimes(view.getState()) }),
    );
  return (
    <div className={styles.place}>
      <p className={styles.hint}>
        {slot === null ? words.board.placeNone({ times }) : words.board.place({ slot, times })}
      </p>
      <Button
        tone="quiet"
        icon="save"
        hint={words.board.keepPlaceHint}
        isDisabled={isUnchanged || isEmpty}
        onPress={keep}
      >
        {words.board.keepPlace}
      </Button>
    </div>
  );
}

/** Erases every slot, after a dialog that names what is lost and what can be restored. */
function EraseControl() {
  const { slots } = useStores();
  const book = useSlots((state) => state.book);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions) ?? {};
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  const held = book.stored;
  const lost = notRestored(book, { versions, broken });
  const { min, max } = useDevice((state) => state.family.slot);
  const mayErase = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  return (
    <Confirm
      tone="quiet"
      icon="erase"
      isDisabled={!mayErase}
      label={words.board.erase}
      title={words.board.eraseTitle}
      text={[
        words.board.eraseText({ slots: max - min + 1 }),
        ...(held.length > 0 ? [words.slots.willGo({ groups: namesOf(held) })] : []),
        ...(lost.length > 0 ? [words.slots.notRestored({ groups: namesOf(lost) })] : []),
      ].join(' ')}
      keepLabel={words.board.eraseKeep}
      confirmLabel={words.board.eraseConfirm}
      closeLabel={words.close}
      onConfirm={() => slots.erase()}
    />
  );
}

function namesOf(groups: readonly { readonly slot: number; readonly name: string }[]): string {
  const { formatNames, formatWhole } = words.numbers;
  return formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`.trim()));
}

const AS_STORED = 100;

/**
 * The board's playing speed in percent, for the chosen slot or for all. A board's speed cannot be read, so the field shows the value to
 * set.
 */
function SpeedControl() {
  const { device, notices } = useStores();
  const slot = useSlot();
  const { min, max } = useDevice((state) => state.family.speedPercent);
  const isAllowed = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const [percent, setPercent] = useState(AS_STORED);
  const [isEverySlot, setEverySlot] = useState(false);
  return (
    <div className={styles.row}>
      <div className={field.named}>
        <span className={styles.label} aria-hidden="true">
          {words.board.speed}
        </span>
        <NumberField
          label={words.board.speedField}
          value={percent}
          min={min}
          max={max}
          step={10}
          unit={words.board.percent}
          onChange={setPercent}
          onRefused={(value) => notices.refuse(words.refused({ name: words.board.speed, value, min, max }))}
        />
      </div>
      <div className={styles.running}>
        <Toggle label={words.board.everySlot} isOn={isEverySlot} onChange={setEverySlot} />
        <Button
          hint={words.board.speedHint}
          isDisabled={!isAllowed}
          onPress={() => device.setSpeed(isEverySlot ? null : slot, percent)}
        >
          {words.board.setSpeed}
        </Button>
      </div>
    </div>
  );
}

export function BoardDetails({ fit }: { readonly fit: ReactNode }) {
  const { commands, id } = useDevice((state) => state.family);
  const why = id === 'unknown' ? words.board.unsure : words.board.absent;
  const canErase = commands.includes('erase');
  return (
    <>
      <HeldRow />
      {fit}
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

/** The assumed board family, with a button to change it. */
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
  const content = useSlotContents()(slot);
  const held = useHeldName()(slot) ?? '';
  const isOther = content === 'other' && held !== '';
  return (
    <div className={styles.row}>
      <div className={styles.about} role="status">
        <Chip truth={CONTENT_TRUTH[content]}>
          {words.board.glance({ slot, badge: words.slots.badge[content] })}
        </Chip>
        <p>{isOther ? words.slots.holdsNamed({ name: held }) : words.slots.holds[content]}</p>
      </div>
      <PlaceControl />
    </div>
  );
}
