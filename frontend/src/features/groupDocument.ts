// The action group that is open, and the board and robot that it is checked and drawn with. It is undoable, saved in the browser's storage
// soon after each edit. Text that cannot be read is never thrown away: it is stored under another key, with a notice. Never
// moves the robot.

import {
  emptyGroup,
  type ActionGroup,
  groupFromText,
  groupToText,
  holdsMotion,
} from '#shared/group/group.ts';
import type { History } from '#shared/document/history.ts';
import type { Clock } from '#shared/clock.ts';
import { words } from '../i18n/words.ts';
import type { Notices } from '../state/notices.ts';
import { createThrottle, type TextStorage } from '../state/storage.ts';
import { createUndoable, type SavedDocument } from '../state/store.ts';
import { familyOfUnit, robotInUnit } from '#shared/profile/units.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { FAMILIES, type Family } from '#shared/codec/families.ts';

export type DocumentState = History<ActionGroup>;

export type Document = SavedDocument<ActionGroup>;

const KEY = 'servodeck.group';
const REPLACED_KEY = 'servodeck.group.unreadable';
/** Once the edit is drawn: to write a large group takes longer than the edit. */
const SAVED_AFTER_MS = 16;

export function createDocument(storage: TextStorage, notices: Notices, clock: Clock): Document {
  let savingFailed = false;
  let settled = load(storage, notices);
  const listeners: ((text: string) => void)[] = [];

  function save(): void {
    const text = groupToText(settled);
    write(text);
    for (const listener of listeners) listener(text);
  }

  function write(text: string): void {
    try {
      storage.setItem(KEY, text);
      if (savingFailed) notices.takeBack(words.actions.notSaved);
      savingFailed = false;
    } catch {
      if (!savingFailed) notices.show('warning', words.actions.notSaved);
      savingFailed = true;
    }
  }

  const saving = createThrottle(clock, SAVED_AFTER_MS, save);
  function saveSoon(group: ActionGroup): void {
    settled = group;
    saving.request();
  }

  const document = createUndoable(settled, saveSoon);
  return {
    ...document,
    take(history) {
      document.store.setState(history, true);
      saveSoon(history.present);
    },
    flush: saving.flush,
    onSave: (listener) => void listeners.push(listener),
  };
}

function load(storage: TextStorage, notices: Notices): ActionGroup {
  const fresh = emptyGroup(words.actions.defaultName, 'us');
  try {
    const text = storage.getItem(KEY);
    if (text === null) return fresh;
    const read = groupFromText(text);
    if ('value' in read) return read.value;
    storage.setItem(REPLACED_KEY, text);
    notices.show('warning', words.actions.broken);
  } catch {
    notices.show('warning', words.actions.notSaved);
  }
  return fresh;
}

export interface GroupBoard {
  readonly family: Family;
  readonly robot: Robot;
  /** The group has another unit than the known board. */
  readonly isOther: boolean;
}

export const knownFamily = (connected: Family, robot: Pick<Robot, 'board'>): Family =>
  connected.id === 'unknown' ? FAMILIES[robot.board] : connected;

export function boardOfGroup(
  group: Pick<ActionGroup, 'unit' | 'frames' | 'blocks'>,
  family: Family,
  robot: Robot,
): GroupBoard {
  const { unit } = group;
  const isOther = holdsMotion(group) && unit !== family.unit;
  return isOther
    ? { family: familyOfUnit(unit), robot: robotInUnit(robot, unit), isOther }
    : { family, robot, isOther };
}
