// A document that exists once per robot, such as its poses: the store holds the one of the current robot, saves it under the robot's id
// and switches with the robot. Unreadable text is stored under another key, never deleted. Moves nothing. Also the last known state of the
// library, to compare robots with.

import * as v from 'valibot';
import { kitFromText, kitToText, type Kit } from '#shared/profile/robotText.ts';
import { startHistory, type History } from '#shared/document/history.ts';
import type { Robot } from '#shared/profile/robot.ts';
import type { Read, TextFlaw } from '#shared/document/schema.ts';
import { saveText, type TextStorage } from '../../state/storage.ts';
import type { Notices } from '../../state/notices.ts';
import type { OwnRobot, RobotStore } from './robots.ts';
import { createUndoable, type Undoable } from '../../state/store.ts';
import { words } from '../../i18n/words.ts';

/** A robot's state in the library when it was last read or written. */
export interface Known {
  readonly document: string;
  readonly revision: number;
  readonly kit: Kit;
}

const KEY = 'servodeck.robots.kept';

const knownSchema = v.record(
  v.string(),
  v.object({
    document: v.string(),
    revision: v.pipe(v.number(), v.safeInteger(), v.minValue(0)),
    text: v.string(),
  }),
);

export function saveKnown(storage: TextStorage, known: ReadonlyMap<number, Known>): void {
  const rows = [...known].map(([id, { document, revision, kit }]) => [
    id,
    { document, revision, text: kitToText(kit) },
  ]);
  // Where storage is forbidden, the robots have already reported it.
  saveText(storage, KEY, JSON.stringify(Object.fromEntries(rows)));
}

export function loadKnown(storage: TextStorage): Map<number, Known> {
  const known = new Map<number, Known>();
  try {
    const rows = v.parse(knownSchema, JSON.parse(storage.getItem(KEY) ?? '{}'));
    for (const [id, { document, revision, text }] of Object.entries(rows)) {
      const kit = kitFromText(text);
      if (kit !== null) known.set(Number(id), { document, revision, kit });
    }
  } catch {
    // The text was not written by this page.
  }
  return known;
}

interface RobotDocumentOptions<T> {
  readonly storage: TextStorage;
  readonly notices: Notices;
  readonly robots: RobotStore;
  /** The storage key without the robot's id. */
  readonly key: string;
  /** The document of a robot without a saved one. */
  fresh(robot: Robot): T;
  toText(value: T): string;
  fromText(text: string): Read<T>;
  /** Removes what only concerns this page, and adds it again. */
  readonly shared?: { of(value: T): T; onto(mine: T, theirs: T): T };
  /** The text of the notice. */
  notSaved(): string;
  unreadable(flaw: TextFlaw): string;
}

const elsewhere = (): string => words.robots.steps.elsewhere;

export interface RobotDocument<T> extends Undoable<T> {
  of(robot: OwnRobot): T;
  /** The text for the library; null if the document is unchanged since the robot was made. */
  textOf(robot: OwnRobot): string | null;
  /** Takes a text from the library; ignores one that this version cannot read. */
  takeIn(robot: OwnRobot, text: string | null): void;
  /** Called after each change of any robot's document. */
  onChange(changed: () => void): void;
}

export function createRobotDocument<T>(options: RobotDocumentOptions<T>): RobotDocument<T> {
  const { storage, notices, robots, key, toText } = options;
  const { shared = { of: (value: T) => value, onto: (_mine: T, theirs: T) => theirs } } = options;
  /** Histories of the other robots. */
  const histories = new Map<number, History<T>>();
  const listeners = new Set<() => void>();
  let owner = robots.current().id;

  function save(id: number, value: T): void {
    try {
      storage.setItem(`${key}.${id}`, toText(value));
    } catch {
      notices.show('warning', options.notSaved());
    }
  }

  const document = createUndoable(load(options, robots.current()), (present) => {
    save(owner, present);
    for (const changed of listeners) changed();
  });

  robots.store.subscribe(() => {
    const taken = robots.current();
    const { id } = taken;
    if (id === owner) return;
    document.commit();
    histories.set(owner, document.store.getState());
    owner = id;
    document.store.setState(histories.get(id) ?? startHistory(load(options, taken)), true);
  });

  function of(robot: OwnRobot): T {
    if (robot.id !== owner) return histories.get(robot.id)?.present ?? load(options, robot);
    const { gesture, present } = document.store.getState();
    return gesture?.value ?? present;
  }

  const sharedText = (value: T): string => toText(shared.of(value));

  function textOf(robot: OwnRobot): string | null {
    const text = sharedText(of(robot));
    return text === sharedText(options.fresh(robot.robot)) ? null : text;
  }

  function takeIn(robot: OwnRobot, text: string | null): void {
    const read = text === null ? { value: options.fresh(robot.robot) } : options.fromText(text);
    if (!('value' in read) || text === textOf(robot)) return;
    const value = shared.onto(of(robot), read.value);
    if (robot.id !== owner) histories.delete(robot.id);
    else if (hasSteps()) document.edit(elsewhere, () => value);
    else document.store.setState(startHistory(value), true);
    save(robot.id, value);
  }

  function hasSteps(): boolean {
    const { past, future, gesture } = document.store.getState();
    return past.length + future.length > 0 || gesture !== null;
  }

  /** Refuses changes of the shared document; what only concerns this page stays allowed. */
  function isRefused(edit: (present: T) => T): boolean {
    const why = robots.refusal();
    if (why === null) return false;
    const { present } = document.store.getState();
    if (sharedText(edit(present)) === sharedText(present)) return false;
    notices.show('warning', why);
    return true;
  }

  return {
    ...document,
    edit(label, edit) {
      if (!isRefused(edit)) document.edit(label, edit);
    },
    preview(edit) {
      if (robots.refusal() === null) document.preview(edit);
    },
    ...{ of, textOf, takeIn },
    onChange: (changed) => void listeners.add(changed),
  };
}

function load<T>(options: RobotDocumentOptions<T>, { id: owner, robot }: OwnRobot): T {
  const { storage, notices, key } = options;
  const empty = options.fresh(robot);
  try {
    const text = storage.getItem(`${key}.${owner}`);
    if (text === null) return empty;
    const read = options.fromText(text);
    if ('value' in read) return read.value;
    storage.setItem(`${key}.${owner}.unreadable`, text);
    notices.show('warning', options.unreadable(read.problem));
  } catch {
    notices.show('warning', options.notSaved());
  }
  return empty;
}
