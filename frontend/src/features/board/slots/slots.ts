// The slots of the board at hand: what is remembered of them, and what downloads make of it, whoever began them. A board in the
// page is new at each link, any other is remembered in the browser's storage. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { concerns, withBegun, withDownload, type LatestDownload } from '#shared/group/slotPlaces.ts';
import {
  EMPTY_SLOT_BOOK,
  slotBookFromText,
  slotBookToText,
  withErased,
  withErasing,
  withStored,
  withUnknown,
  withVersions,
  type SlotBook,
  type SlotRecord,
} from '#shared/group/slotBook.ts';
import type { SlotGroup } from '#shared/robot/state.ts';
import { downloadedSentence, downloadCancelled } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/words.ts';
import { nameOf } from '../../../robot/remembered.ts';
import { boardFingerprint } from '../compile/compileSource.ts';
import type { Settled } from '../../../robot/boardVerbs.ts';
import type { Device, DeviceState } from '../../../robot/device.ts';
import type { TextStorage } from '../../../state/soon.ts';
import type { Notices } from '../../../state/notices.ts';
import type { RobotStore } from '../../profiles/robots.ts';

/** `replaces`: what was seen in the slot, as `versionIn` had it then; left out: as it is now. */
export type SlotDownload = Pick<SlotRecord, 'slot' | 'name' | 'documentId' | 'frames'> &
  Pick<SlotGroup, 'replaces'>;

export interface SlotsState {
  readonly book: SlotBook;
}

export interface Slots {
  readonly store: StoreApi<SlotsState>;
  /** One after the other, until one fails or is called off. `settled` hears whether all of them are stored. */
  download(groups: readonly SlotDownload[], settled?: Settled): void;
  cancel(): void;
  /** What a shared link says was stored there last, '' for nothing; undefined on one's own. */
  versionIn(slot: number): string | undefined;
  /** What somebody else stored, once it was found whole; as long as it still stands there. */
  noteOthers(record: SlotRecord): void;
  erase(): void;
  /** Downloads again what the last erase took. */
  restoreAll(): void;
}

const KEY = 'servodeck.slots';

export interface SlotsOptions {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly notices: Notices;
  readonly storage: TextStorage;
  /** Milliseconds since 1970. */
  today(): number;
}

export function createSlots({ device, robots, notices, storage, today }: SlotsOptions): Slots {
  const store = createStore<SlotsState>(() => ({ book: EMPTY_SLOT_BOOK }));
  let key: string | null = null;
  /** Asked for here, and whether its end is still to come. */
  let wanted: readonly SlotRecord[] = [];
  let isAsking = false;

  function keep(book: SlotBook): void {
    if (book === store.getState().book) return;
    store.setState({ book });
    if (key === null) return;
    try {
      storage.setItem(key, slotBookToText(book));
    } catch {
      notices.tell('warning', words.slots.notSaved);
    }
  }

  function load(from: string | null): SlotBook {
    try {
      const text = from === null ? null : storage.getItem(from);
      const read = text === null ? null : slotBookFromText(text);
      // What cannot be read says nothing of the board.
      return read !== null && 'value' in read ? read.value : EMPTY_SLOT_BOOK;
    } catch {
      return EMPTY_SLOT_BOOK;
    }
  }

  let board: string | null = null;

  device.store.subscribe((state, before) => {
    const next = boardOf(state);
    if (next !== board) {
      board = next;
      key = state.way?.kind === 'simulated' || next === null ? null : `${KEY} ${next}`;
      store.setState({ book: load(key) });
    }
    // From here on nobody knows what is left, whatever the board will say.
    if (isErasing(state) && !isErasing(before)) keep(withErasing(store.getState().book));
    noteDownload(state);
    takeBackMended(before.snapshot.brokenSlots, state.snapshot.brokenSlots);
    // Until it has ended, versions may still be told that it has taken.
    if (!isErasing(state)) noteVersions(state);
  });

  /** That a slot is broken is said until it is empty or whole. */
  function takeBackMended(before: readonly number[], now: readonly number[]): void {
    if (now === before) return;
    for (const slot of before) if (!now.includes(slot)) notices.takeBack(downloadCancelled(slot));
  }

  /** Others may have stored something there while this page was away. */
  function noteVersions({ snapshot: { link, slotVersions } }: DeviceState): void {
    if (link.status === 'ready' && slotVersions !== null)
      keep(withVersions(store.getState().book, slotVersions));
  }

  function versionIn(slot: number): string | undefined {
    const { slotVersions } = device.store.getState().snapshot;
    return slotVersions === null ? undefined : (slotVersions[slot]?.version ?? '');
  }

  function noteOthers(record: SlotRecord): void {
    const { book } = store.getState();
    const isKnown = book.stored.some(({ slot }) => slot === record.slot);
    if (!isKnown && versionIn(record.slot) === record.fingerprint) keep(withStored(book, record));
  }

  function recordOf({ slot, name, documentId, frames }: SlotDownload): SlotRecord {
    const fingerprint = boardFingerprint(robots.current().robot, frames);
    return { slot, name, documentId, frames, fingerprint, storedAtMs: today() };
  }

  function noteDownload({ snapshot: { link, activity, brokenSlots, lastDownload } }: DeviceState): void {
    if (activity.kind === 'downloading') {
      const latest = { ...activity, isOver: false };
      // From its first byte on the slot is broken, until all of it has arrived.
      if (brokenSlots.includes(activity.slot)) noteBegun(activity.slot, latest);
      noteNews(latest, brokenSlots);
    } else if (link.status === 'ready') {
      noteNews(lastDownload && { ...lastDownload, isOver: true }, brokenSlots);
    }
  }

  function noteBegun(slot: number, latest: LatestDownload): void {
    const { book } = store.getState();
    if (wanted.length > 0 && wanted.map((record) => record.slot).join() === latest.slots.join()) {
      keep(withBegun(book, wanted));
      wanted = [];
    } else if (!concerns(latest, book)) {
      // Another's.
      keep(withUnknown(book, slot));
    }
  }

  /** It may have gone on without this page. */
  function noteNews(latest: LatestDownload | null, broken: readonly number[]): void {
    const { book } = store.getState();
    const next = withDownload(book, latest, broken);
    if (next === book) return;
    keep(next);
    const arrived = book.begun.filter((record) => next.stored.includes(record)).map(({ slot }) => slot);
    if (arrived.length === 0 || next.begun.length > 0 || isAsking) return;
    notices.tell(
      'info',
      downloadedSentence(latest !== null && concerns(latest, book) ? latest.slots : arrived),
    );
  }

  function download(groups: readonly SlotDownload[], settled: Settled = () => undefined): void {
    if (isAsking) return settled(false);
    isAsking = true;
    wanted = groups.map(recordOf);
    device.download(groups.map(groupOf), (isDone) => {
      isAsking = false;
      // Told so late that nobody saw it under way.
      if (isDone) keep(wanted.reduce(withStored, store.getState().book));
      wanted = [];
      settled(isDone);
    });
  }

  function groupOf({ slot, frames, name, documentId, replaces = versionIn(slot) }: SlotDownload): SlotGroup {
    return { slot, frames, name, documentId, ...(replaces !== undefined && { replaces }) };
  }

  return {
    store,
    versionIn,
    noteOthers,
    download,
    cancel: () => device.cancelDownload(),
    erase: () =>
      device.erase((isDone) => {
        if (isDone) keep(withErased(store.getState().book));
      }),
    restoreAll: () => download(store.getState().book.erased),
  };
}

/** A board is known by its way and by what it is taken for; null before there is one. */
function boardOf({ way, family }: DeviceState): string | null {
  return way === null || family.id === 'unknown' ? null : `${family.id} ${nameOf(way)}`;
}

const isErasing = ({ snapshot }: DeviceState): boolean => snapshot.activity.kind === 'erasing';
