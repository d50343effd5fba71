// The action group being written: undoable, saved in the browser's storage after each edit. Text that cannot be read is
// never thrown away: it is set aside under another key and the person is told. Never moves the robot.

import { emptyGroup, type ActionGroup } from '#shared/actions/group/group.ts';
import { groupFromText, groupToText } from '#shared/actions/group/groupText.ts';
import type { History } from '#shared/actions/history.ts';
import { words } from '../words/words.ts';
import type { Notices } from './notices.ts';
import { createUndoable, type Undoable } from './undoable.ts';

export type DocumentState = History<ActionGroup>;

export interface Document extends Undoable<ActionGroup> {
  /** Shows another group, with the steps that it was left with. */
  take(history: History<ActionGroup>): void;
}

/** The part of the browser's Storage that is needed; it may throw, as it does where storage is forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

const KEY = 'servodeck.group';
const ASIDE_KEY = 'servodeck.group.unreadable';

export function createDocument(storage: TextStorage, notices: Notices): Document {
  let savingFailed = false;

  function save(group: ActionGroup): void {
    try {
      storage.setItem(KEY, groupToText(group));
      savingFailed = false;
    } catch {
      if (!savingFailed) notices.tell('warning', words.actions.notSaved);
      savingFailed = true;
    }
  }

  const document = createUndoable(load(storage, notices), save);
  return {
    ...document,
    take(history) {
      document.store.setState(history, true);
      save(history.present);
    },
  };
}

function load(storage: TextStorage, notices: Notices): ActionGroup {
  const fresh = emptyGroup(words.actions.defaultName, 'us');
  try {
    const text = storage.getItem(KEY);
    if (text === null) return fresh;
    const read = groupFromText(text);
    if ('value' in read) return read.value;
    storage.setItem(ASIDE_KEY, text);
    notices.tell('warning', words.actions.broken);
  } catch {
    notices.tell('warning', words.actions.notSaved);
  }
  return fresh;
}
