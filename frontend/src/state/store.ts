// How stores of the page change: one immutable value with undo history and gestures, or only the values that differ. Knows neither storage
// nor the kind of value.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  begin,
  cancel,
  commit,
  preview,
  record,
  redo,
  startHistory,
  undo,
  type History,
  type Label,
} from '#shared/document/history.ts';

export interface Undoable<T> {
  readonly store: StoreApi<History<T>>;
  /** One finished edit, one step. */
  edit(label: Label, edit: (present: T) => T): void;
  /** A gesture: begin, preview from where it began, then commit or cancel. One gesture, one step. */
  begin(label: Label): void;
  preview(edit: (before: T) => T): void;
  commit(): void;
  cancel(): void;
  undo(): void;
  redo(): void;
}

/** A document that is saved by itself soon after each edit. */
export interface SavedDocument<T> extends Undoable<T> {
  /** Replaces the value together with its history. */
  take(history: History<T>): void;
  /** Saves pending edits now: the page may be about to close. */
  flush(): void;
  /** Calls `listener` together with each save, so that a crash cannot come between two copies. */
  onSave(listener: (text: string) => void): void;
}

/** Calls `settled` with each value that no gesture can cancel any more. */
export function createUndoable<T>(initial: T, settled: (present: T) => void): Undoable<T> {
  const store = createStore<History<T>>(() => startHistory(initial));

  function change(next: History<T>): void {
    const before = store.getState();
    store.setState(next, true);
    if (next.gesture === null && (next.present !== before.present || before.gesture !== null))
      settled(next.present);
  }

  return {
    store,
    edit(label, edit) {
      const whole = commit(store.getState());
      change(record(whole, label, edit(whole.present)));
    },
    begin: (label) => change(begin(store.getState(), label)),
    preview(edit) {
      const state = store.getState();
      if (state.gesture !== null) change(preview(state, edit(state.gesture.value)));
    },
    commit: () => change(commit(store.getState())),
    cancel: () => change(cancel(store.getState())),
    undo: () => change(undo(store.getState())),
    redo: () => change(redo(store.getState())),
  };
}

export function setChanged<State extends object>(store: StoreApi<State>, next: Partial<State>): void {
  const before = store.getState();
  const isSame = (Object.keys(next) as (keyof State)[]).every((key) => Object.is(next[key], before[key]));
  if (!isSame) store.setState(next);
}
