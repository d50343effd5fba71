// The dialog with the map of the board's slots, and beside it the details of the chosen one.

import styles from './Slots.module.css';
import { useEffect, useRef, type KeyboardEvent, useState } from 'react';
import { compareFrames } from '#shared/group/frames.ts';
import { type SlotRecord, type SlotContent, recordOf } from '#shared/group/slotBook.ts';
import { slotTrigger, type SlotTrigger } from '#shared/codec/families.ts';
import { totalDurationMs } from '#shared/group/group.ts';
import { servoName, triggerText } from '../../../i18n/sentences.ts';
import { useCompiled, useDevice, useStores, useSlot, useSlots, useSnapshot } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { Mark, Chip } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { CONTENT_TRUTH, useSlotContents, useHeldName } from './slotHooks.ts';
import { DownloadControl } from '../DownloadAndRun.tsx';
import { motionHindrance, startHindrance } from '../../../robot/readiness.ts';
import { Button } from '../../../ui/Button.tsx';
import { SeveralGroups } from './SeveralGroups.tsx';

const SHOWN = 8;

/** How the copy on the board differs from the open group as it would be downloaded now. */
function Comparison({ record }: { readonly record: SlotRecord }) {
  const { frames, source } = useCompiled((state) => state.latest);
  const { isSame, frameCounts, durationsMs, firstDifferent, servos } = compareFrames(record.frames, frames);
  const [[boardFrames, hereFrames], [boardMs, hereMs]] = [frameCounts, durationsMs];
  const placeText = (position: number | null): string =>
    position === null ? words.slots.notMoved : words.numbers.formatWhole(position);
  return (
    <div className={styles.comparison} role="status">
      {isSame ? (
        <p>{words.slots.same}</p>
      ) : (
        <>
          <p>{words.slots.lengths({ boardFrames, boardMs, frames: hereFrames, ms: hereMs })}</p>
          {firstDifferent !== null && <p>{words.slots.firstDifferent({ frame: firstDifferent + 1 })}</p>}
          <ul>
            {servos.slice(0, SHOWN).map(({ servo, positions: [onBoard, here] }) => (
              <li key={servo}>
                {words.slots.differs({
                  ...{ name: servoName(source.robot, servo), onBoard: placeText(onBoard) },
                  here: placeText(here),
                })}
              </li>
            ))}
          </ul>
        </>
      )}
    </div>
  );
}

/** All slots as a grid with one tab stop: a mark for the content, a word for what plays it. Download and Run use the chosen slot. */
function SlotMap() {
  const { view } = useStores();
  const { slot: range, id } = useDevice((state) => state.family);
  const chosen = useSlot();
  const heldIn = useHeldName();
  const contentOf = useSlotContents();
  const grid = useRef<HTMLDivElement>(null);
  const wantsFocus = useRef(false);
  const slots = Array.from({ length: range.max - range.min + 1 }, (_, index) => range.min + index);

  useEffect(() => {
    if (wantsFocus.current) grid.current?.querySelector<HTMLElement>('[tabindex="0"]')?.focus();
    wantsFocus.current = false;
  }, [chosen]);

  const key = (event: KeyboardEvent): void => {
    const next = slotAfterKey(event.key, chosen, { ...range, columns: columnsOf(grid.current) });
    if (next === null) return;
    event.preventDefault();
    wantsFocus.current = true;
    view.setState({ slot: next });
  };

  return (
    <div ref={grid} className={styles.map} role="listbox" aria-label={words.slots.map} onKeyDown={key}>
      {slots.map((slot) => {
        const content = contentOf(slot);
        const trigger = slotTrigger(id, slot);
        const name = heldIn(slot);
        return (
          <button
            key={slot}
            type="button"
            role="option"
            className={cx(styles.cell, content !== 'unknown' && content !== 'empty' && styles.full)}
            aria-selected={slot === chosen}
            tabIndex={slot === chosen ? 0 : -1}
            aria-label={cellText(slot, content, name)}
            onClick={() => view.setState({ slot })}
          >
            <span className={styles.number}>{words.numbers.formatWhole(slot)}</span>
            {content !== 'unknown' && <Mark truth={CONTENT_TRUTH[content]} />}
            <span className={styles.held}>{name ?? (trigger && triggerShort(trigger))}</span>
          </button>
        );
      })}
    </div>
  );
}

/** As laid out by the style sheet. */
const columnsOf = (grid: HTMLElement | null): number =>
  grid === null ? 1 : getComputedStyle(grid).gridTemplateColumns.split(' ').length;

function cellText(slot: number, content: SlotContent, name: string | undefined): string {
  const about = words.slots.about[content];
  return name === undefined
    ? words.slots.cell({ slot, about })
    : words.slots.cellNamed({ slot, name, about });
}

function triggerShort(trigger: SlotTrigger): string {
  return trigger.kind === 'pad'
    ? words.slots.padSigns[trigger.button]
    : words.slots.triggersShort[trigger.kind];
}

const VERSION_LENGTH = 6;

/** `onSeveral` opens the download of several groups; null where the board takes none. */
function SlotDetails({ onSeveral }: { readonly onSeveral: (() => void) | null }) {
  const slot = useSlot();
  const { id, commands } = useDevice((state) => state.family);
  const content = useSlotContents()(slot);
  const trigger = slotTrigger(id, slot);
  return (
    <section className={styles.details} aria-label={words.slots.name({ slot })}>
      <h3>{words.slots.name({ slot })}</h3>
      <Chip truth={CONTENT_TRUTH[content]}>{words.slots.badge[content]}</Chip>
      <p>{words.slots.about[content]}</p>
      <Held slot={slot} />
      {trigger !== null && <p className={styles.warning}>{triggerText(trigger)}</p>}
      <Verbs />
      {commands.includes('download') && <DownloadControl />}
      {onSeveral !== null && (
        <Button icon="download" onPress={onSeveral}>
          {words.slots.several.open}
        </Button>
      )}
      <Restore />
    </section>
  );
}

/** From this page's downloads, or from the gateway for groups that others downloaded. */
function Held({ slot }: { readonly slot: number }) {
  const record = useSlots((state) => recordOf(state.book, slot));
  const others = useSnapshot((snapshot) => snapshot.slotVersions?.[slot]);
  const isBroken = useSnapshot(({ brokenSlots }) => brokenSlots.includes(slot));
  // The former content is gone.
  if (isBroken) return null;
  if (record !== undefined && record.by === undefined) {
    const { name, storedAtMs, frames, fingerprint } = record;
    const when = words.dates.formatMoment(storedAtMs);
    const version = fingerprint.slice(0, VERSION_LENGTH);
    return (
      <p className={styles.dim}>
        {words.slots.stored({
          ...{ name: name || words.slots.noName, count: frames.length, durationMs: totalDurationMs(frames) },
          ...{ when, version },
        })}
      </p>
    );
  }
  if (others === undefined) return null;
  const { name, by, atMs } = others;
  const size =
    record &&
    words.slots.several.about({ count: record.frames.length, durationMs: totalDurationMs(record.frames) });
  const version = others.version.slice(0, VERSION_LENGTH);
  const facts = [
    name || words.slots.noName,
    ...(size === undefined ? [] : [size]),
    by === '' ? words.slots.downloadedElsewhere : words.slots.downloadedBy({ name: by }),
    ...(atMs === null ? [] : [words.dates.formatMoment(atMs)]),
    words.slots.version({ version }),
  ];
  return (
    <>
      <p className={styles.dim}>{facts.join(words.comma)}</p>
      {record === undefined && <p className={styles.dim}>{words.slots.notInLibrary}</p>}
    </>
  );
}

function Verbs() {
  const { device } = useStores();
  const slot = useSlot();
  const record = useSlots((state) => recordOf(state.book, slot));
  const [compared, setCompared] = useState<number | null>(null);
  const canRun = useDevice((state) => state.family.commands.includes('run'));
  const mayRun = useSnapshot(
    (snapshot) =>
      motionHindrance(snapshot) === null &&
      snapshot.activity.kind !== 'playing' &&
      !snapshot.brokenSlots.includes(slot),
  );
  return (
    <>
      <div className={styles.verbs}>
        {canRun && (
          <Button icon="play" isDisabled={!mayRun} onPress={() => device.run(slot, 1)}>
            {words.slots.run}
          </Button>
        )}
        <Button isDisabled={record === undefined} onPress={() => setCompared(slot)}>
          {words.slots.compare}
        </Button>
      </div>
      {compared === slot && record !== undefined && <Comparison record={record} />}
    </>
  );
}

function Restore() {
  const { slots } = useStores();
  const { erased } = useSlots((state) => state.book);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  if (erased.length === 0) return null;
  return (
    <Button
      icon="undo"
      hint={words.slots.restoreHint}
      isDisabled={!mayStart}
      onPress={() => slots.restoreAll()}
    >
      {words.slots.restoreAll({ count: erased.length })}
    </Button>
  );
}

export function SlotBoard({ isSeveralFirst = false }: { readonly isSeveralFirst?: boolean }) {
  const [isSeveral, setSeveral] = useState(isSeveralFirst);
  const canDownload = useDevice((state) => state.family.commands.includes('download'));
  return (
    <>
      <p className={styles.intro}>{words.slots.intro}</p>
      <div className={styles.sides}>
        <SlotMap />
        {isSeveral && canDownload ? (
          <SeveralGroups onBack={() => setSeveral(false)} />
        ) : (
          <SlotDetails onSeveral={canDownload ? () => setSeveral(true) : null} />
        )}
      </div>
    </>
  );
}

interface SlotGrid {
  readonly min: number;
  readonly max: number;
  readonly columns: number;
}

/** The slot that a key leads to; null for other keys. */
export function slotAfterKey(key: string, slot: number, { min, max, columns }: SlotGrid): number | null {
  const next = {
    ArrowLeft: slot - 1,
    ArrowRight: slot + 1,
    ArrowUp: slot - columns,
    ArrowDown: slot + columns,
    Home: min,
    End: max,
  }[key];
  if (next === undefined) return null;
  return next < min || next > max ? slot : next;
}
