// The slots of the board at hand: what is remembered of them, and downloads one after the other with one progress. A board in the
// page is new at each link, any other is remembered in the browser's storage. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  EMPTY_SLOT_BOOK,
  slotBookFromText,
  slotBookToText,
  withBegun,
  withErased,
  withErasing,
  withStored,
  type SlotBook,
  type SlotRecord,
} from '#shared/actions/slots/slotBook.ts';
import { words } from '../words/words.ts';
import { nameOf } from './boards.ts';
import { boardFingerprint } from './workedOut.ts';
import type { Device, DeviceState, Settled } from './device.ts';
import type { TextStorage } from './document.ts';
import type { Notices } from './notices.ts';
import type { RobotStore } from './robots.ts';

export type SlotDownload = Pick<SlotRecord, 'slot' | 'name' | 'documentId' | 'frames'>;

export interface SlotJob {
  readonly count: number;
  readonly done: number;
  /** Of all of it. */
  readonly frameCount: number;
  /** In the groups that are whole. */
  readonly framesDone: number;
}

export interface SlotsState {
  readonly book: SlotBook;
  /** null: nothing is being downloaded. */
  readonly job: SlotJob | null;
}

export interface Slots {
  readonly store: StoreApi<SlotsState>;
  /** One after the other, until one fails or is called off. `settled` hears whether all of them are stored. */
  download(groups: readonly SlotDownload[], settled?: Settled): void;
  cancel(): void;
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
  const store = createStore<SlotsState>(() => ({ book: EMPTY_SLOT_BOOK, job: null }));
  let key: string | null = null;
  let isCancelled = false;
  let underWay: SlotDownload | null = null;

  function keep(book: SlotBook): void {
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
    if (underWay !== null) noteBegun(underWay, state);
    else noteEnd(state);
  });

  function recordOf({ slot, name, documentId, frames }: SlotDownload): SlotRecord {
    const fingerprint = boardFingerprint(robots.current().robot, frames);
    return { slot, name, documentId, frames, fingerprint, storedAtMs: today() };
  }

  /** From its first byte on the slot is broken, until all of it has arrived. */
  function noteBegun(group: SlotDownload, { snapshot: { activity, brokenSlots } }: DeviceState): void {
    const { book } = store.getState();
    const isAtIt = activity.kind === 'downloading' && brokenSlots.includes(group.slot);
    if (book.begun === null && isAtIt) keep(withBegun(book, recordOf(group)));
  }

  /** It may have gone on without this page. */
  function noteEnd({ snapshot: { link, activity, brokenSlots } }: DeviceState): void {
    const { book } = store.getState();
    if (book.begun === null || link.status !== 'ready' || activity.kind === 'downloading') return;
    const { slot } = book.begun;
    if (brokenSlots.includes(slot)) return keep(withBegun(book, null));
    keep(withStored(book, book.begun));
    notices.tell('info', words.board.downloaded(slot));
  }

  function download(groups: readonly SlotDownload[], settled: Settled = () => undefined): void {
    if (store.getState().job !== null) return settled(false);
    const frameCount = groups.reduce((sum, { frames }) => sum + frames.length, 0);
    store.setState({ job: { count: groups.length, done: 0, frameCount, framesDone: 0 } });
    isCancelled = false;
    next(groups, settled);
  }

  function next([group, ...rest]: readonly SlotDownload[], settled: Settled): void {
    const { job } = store.getState();
    if (group === undefined || job === null) return end(true, settled);
    const { slot, frames } = group;
    underWay = group;
    device.download(slot, frames, (isDone) => {
      underWay = null;
      if (isDone) keep(withStored(store.getState().book, recordOf(group)));
      else noteEnd(device.store.getState());
      // A group that is called off in its last frame is whole nevertheless.
      if (!isDone || isCancelled) return end(false, settled);
      const framesDone = job.framesDone + frames.length;
      store.setState({ job: { ...job, done: job.done + 1, framesDone } });
      next(rest, settled);
    });
  }

  function end(isDone: boolean, settled: Settled): void {
    store.setState({ job: null });
    settled(isDone);
  }

  return {
    store,
    download,
    cancel() {
      isCancelled = true;
      device.cancelDownload();
    },
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
