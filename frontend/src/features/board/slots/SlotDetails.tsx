// The chosen slot: what it holds and since when, what plays it, how it differs from the group at hand, and what can be done with it.

import { useState } from 'react';
import { totalDurationMs } from '#shared/group/group.ts';
import { recordOf } from '#shared/group/slotBook.ts';
import { slotTrigger } from '#shared/codec/families.ts';
import { DownloadControl } from '../DownloadControl.tsx';
import { motionHindrance, startHindrance } from '../../../robot/readiness.ts';
import { useDevice, useSlots, useSnapshot, useStores, useSlot } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Chip } from '../../../ui/Chip.tsx';
import { triggerText } from '../../../i18n/sentences/slots.ts';
import { words } from '../../../i18n/whole.ts';
import { Comparison } from './Comparison.tsx';
import { FATE_TRUTH, useFates } from './useFates.ts';
import styles from './Slots.module.css';

const VERSION_LENGTH = 6;

/** `onSeveral`: several groups shall be downloaded; null where the board takes none. */
export function SlotDetails({ onSeveral }: { readonly onSeveral: (() => void) | null }) {
  const slot = useSlot();
  const { id, commands } = useDevice((state) => state.family);
  const fate = useFates()(slot);
  const trigger = slotTrigger(id, slot);
  return (
    <section className={styles.details} aria-label={words.slots.name({ slot })}>
      <h3>{words.slots.name({ slot })}</h3>
      <Chip truth={FATE_TRUTH[fate]}>{words.slots.badge[fate]}</Chip>
      <p>{words.slots.about[fate]}</p>
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

/** As it was noted here; what others stored, as the link tells of it. */
function Held({ slot }: { readonly slot: number }) {
  const record = useSlots((state) => recordOf(state.book, slot));
  const others = useSnapshot((snapshot) => snapshot.slotVersions?.[slot]);
  const isBroken = useSnapshot(({ brokenSlots }) => brokenSlots.includes(slot));
  // What was there is gone.
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
