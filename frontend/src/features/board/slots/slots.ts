// The slots of the connected board: their known contents and how downloads, also those of other people, change them. Contents of real
// boards are remembered in the browser's storage; a simulated board starts empty at each link. Knows no panel.

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
import { nameOf } from '../../../robot/device.ts';
import { boardFingerprint } from '#shared/group/fingerprint.ts';
import type { Settled } from '../../../robot/boardVerbs.ts';
import type { Device, DeviceState } from '../../../robot/device.ts';
import type { TextStorage } from '../../../state/storage.ts';
import type { Notices } from '../../../state/notices.ts';
import type { RobotStore } from '../../profiles/robots.ts';

/** `replaces`: the slot's content when the person decided, from `versionIn`; if absent, the current content. */
export type SlotDownload = Pick<SlotRecord, 'slot' | 'name' | 'documentId' | 'frames'> &
  Pick<SlotGroup, 'replaces'>;

export interface SlotsState {
  readonly book: SlotBook;
}

export interface Slots {
  readonly store: StoreApi<SlotsState>;
  /** Downloads one after the other until one fails or is cancelled. Calls `settled` with whether all are stored. */
  download(groups: readonly SlotDownload[], settled?: Settled): void;
  cancel(): void;
  /** The version stored last as a shared link reports it, '' for none; undefined on a link that is not shared. */
  versionIn(slot: number): string | undefined;
  /** Records a group that another person downloaded, if the slot still holds it. */
  noteOthers(record: SlotRecord): void;
  erase(): void;
  /** Downloads the groups again that the last erase removed. */
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
  /** The download that this page requested, until its end. */
  let wanted: readonly SlotRecord[] = [];
  let isAsking = false;

  function keep(book: SlotBook): void {
    if (book === store.getState().book) return;
    store.setState({ book });
    if (key === null) return;
    try {
      storage.setItem(key, slotBookToText(book));
    } catch {
      notices.show('warning', words.slots.notSaved);
    }
  }

  function load(from: string | null): SlotBook {
    try {
      const text = from === null ? null : storage.getItem(from);
      const read = text === null ? null : slotBookFromText(text);
      // Text that cannot be read is ignored.
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
    // From now on the contents are unknown, whatever the board answers.
    if (isErasing(state) && !isErasing(before)) keep(withErasing(store.getState().book));
    noteDownload(state);
    takeBackMended(before.snapshot.brokenSlots, state.snapshot.brokenSlots);
    // Until it has ended, the link may still report versions that it has erased.
    if (!isErasing(state)) noteVersions(state);
  });

  /** A slot counts as broken until it is empty or complete. */
  function takeBackMended(before: readonly number[], now: readonly number[]): void {
    if (now === before) return;
    for (const slot of before) if (!now.includes(slot)) notices.takeBack(downloadCancelled(slot));
  }

  /** Other people may have downloaded groups while this page was away. */
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
      // The slot is broken from the first byte until the last one has arrived.
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
      // A download of another page.
      keep(withUnknown(book, slot));
    }
  }

  /** The download may have continued without this page. */
  function noteNews(latest: LatestDownload | null, broken: readonly number[]): void {
    const { book } = store.getState();
    const next = withDownload(book, latest, broken);
    if (next === book) return;
    keep(next);
    const arrived = book.begun.filter((record) => next.stored.includes(record)).map(({ slot }) => slot);
    if (arrived.length === 0 || next.begun.length > 0 || isAsking) return;
    notices.show(
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
      // Reported only after its end.
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

/** Identifies a board by its connection and assumed family; null without a board. */
function boardOf({ way, family }: DeviceState): string | null {
  return way === null || family.id === 'unknown' ? null : `${family.id} ${nameOf(way)}`;
}

const isErasing = ({ snapshot }: DeviceState): boolean => snapshot.activity.kind === 'erasing';
