// The action group being written: undoable, saved in the browser's storage after each edit. Text that cannot be read is
// never thrown away: it is set aside under another key and the person is told. Never moves the robot.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { emptyGroup, type ActionGroup } from '#shared/actions/group.ts';
import { groupFromText, groupToText } from '#shared/actions/groupText.ts';
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
} from '#shared/actions/history.ts';
import { words } from '../words/en.ts';
import type { Notices } from './notices.ts';

export type DocumentState = History<ActionGroup>;
export type Edit = (group: ActionGroup) => ActionGroup;

/** The part of the browser's Storage that is needed; it may throw, as it does where storage is forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

export interface Document {
  readonly store: StoreApi<DocumentState>;
  /** One finished edit, one step. */
  edit(label: string, edit: Edit): void;
  /** A gesture: begin, preview from where it began, then commit or cancel. One gesture, one step. */
  begin(label: string): void;
  preview(edit: Edit): void;
  commit(): void;
  cancel(): void;
  undo(): void;
  redo(): void;
}

const KEY = 'servodeck.group';
const ASIDE_KEY = 'servodeck.group.unreadable';

export function createDocument(storage: TextStorage, notices: Notices): Document {
  const store = createStore<DocumentState>(() => startHistory(load(storage, notices)));
  let savingFailed = false;

  function change(next: DocumentState): void {
    const before = store.getState();
    store.setState(next, true);
    if (next.gesture === null && next.present !== before.present) save(next.present);
    else if (next.gesture === null && before.gesture !== null) save(next.present);
  }

  function save(group: ActionGroup): void {
    try {
      storage.setItem(KEY, groupToText(group));
      savingFailed = false;
    } catch {
      if (!savingFailed) notices.tell('warning', words.actions.notSaved);
      savingFailed = true;
    }
  }

  return {
    store,
    edit: (label, edit) => {
      const settled = commit(store.getState());
      change(record(settled, label, edit(settled.present)));
    },
    begin: (label) => change(begin(store.getState(), label)),
    preview: (edit) => {
      const state = store.getState();
      if (state.gesture !== null) change(preview(state, edit(state.gesture.value)));
    },
    commit: () => change(commit(store.getState())),
    cancel: () => change(cancel(store.getState())),
    undo: () => change(undo(store.getState())),
    redo: () => change(redo(store.getState())),
  };
}

function load(storage: TextStorage, notices: Notices): ActionGroup {
  const fresh = emptyGroup(words.actions.defaultName, 'us');
  try {
    const text = storage.getItem(KEY);
    if (text === null) return fresh;
    const group = groupFromText(text);
    if (group !== null) return group;
    storage.setItem(ASIDE_KEY, text);
    notices.tell('warning', words.actions.broken);
  } catch {
    notices.tell('warning', words.actions.notSaved);
  }
  return fresh;
}
