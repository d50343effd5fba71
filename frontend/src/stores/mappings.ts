// What pad and keys do, for each robot: undoable, saved in the browser's storage under the robot's number. Text that cannot be
// read is set aside, never thrown away. A robot without an entry has its ready mapping. Moves nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { record, redo, startHistory, undo, type History } from '#shared/actions/history.ts';
import type { Mapping } from '#shared/actions/mapping.ts';
import { readyMapping } from '#shared/actions/mappingReady.ts';
import { mappingFromText, mappingToText } from '#shared/actions/mappingText.ts';
import type { Robot } from '#shared/actions/robot.ts';
import { words } from '../words/en.ts';
import type { TextStorage } from './document.ts';
import type { Notices } from './notices.ts';
import type { RobotStore } from './robots.ts';

export interface MappingStore {
  /** Of the robot at hand. */
  readonly store: StoreApi<History<Mapping>>;
  edit(label: string, change: (mapping: Mapping) => Mapping): void;
  undo(): void;
  redo(): void;
}

const KEY = 'servodeck.mapping';

export function createMappings(storage: TextStorage, notices: Notices, robots: RobotStore): MappingStore {
  const { id, robot } = robots.current();
  const store = createStore<History<Mapping>>(() => startHistory(load(id, robot)));
  /** Histories of robots that are not at hand. */
  const aside = new Map<number, History<Mapping>>();
  let owner = id;

  function load(robotId: number, of: Robot): Mapping {
    try {
      const text = storage.getItem(`${KEY}.${robotId}`);
      const mapping = text === null ? null : mappingFromText(text);
      if (mapping !== null) return mapping;
      if (text !== null) {
        storage.setItem(`${KEY}.${robotId}.unreadable`, text);
        notices.tell('warning', words.pad.unreadable);
      }
    } catch {
      notices.tell('warning', words.pad.notSaved);
    }
    return readyMapping(of);
  }

  function change(next: History<Mapping>): void {
    if (next === store.getState()) return;
    store.setState(next, true);
    try {
      storage.setItem(`${KEY}.${owner}`, mappingToText(next.present));
    } catch {
      notices.tell('warning', words.pad.notSaved);
    }
  }

  robots.store.subscribe(() => {
    const taken = robots.current();
    if (taken.id === owner) return;
    aside.set(owner, store.getState());
    owner = taken.id;
    store.setState(aside.get(owner) ?? startHistory(load(owner, taken.robot)), true);
  });

  return {
    store,
    edit: (label, edit) => change(record(store.getState(), label, edit(store.getState().present))),
    undo: () => change(undo(store.getState())),
    redo: () => change(redo(store.getState())),
  };
}
