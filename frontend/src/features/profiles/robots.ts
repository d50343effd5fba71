// The robots and the current one: undoable, saved in the browser's storage after each edit. Unreadable text is stored under another key,
// never deleted. Knows no link and no library: robotSync.ts passes changes of other people.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  commit,
  rebase,
  record,
  redo,
  startHistory,
  undo,
  type History,
  type Label,
} from '#shared/document/history.ts';
import { readyRobot, usualRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { flawOf, NAME_LENGTH, type Robot, type RobotFlaw } from '#shared/profile/robot.ts';
import { robotFromText, robotToText } from '#shared/profile/robotText.ts';
import type { FamilyId } from '#shared/codec/families.ts';
import { robotNames, longerName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { TextStorage } from '../../state/storage.ts';
import type { Notices } from '../../state/notices.ts';

export interface OwnRobot {
  /** Has no meaning outside this store; never reused. */
  readonly id: number;
  readonly robot: Robot;
}

export interface Robots {
  readonly own: readonly OwnRobot[];
  /** The current robot. */
  readonly currentId: number;
  readonly nextId: number;
}

export interface RobotStore {
  readonly store: StoreApi<History<Robots>>;
  current(): OwnRobot;
  /** The robot for a board: the current one, else the last one described for it, else a new usual one. */
  takeUpFor(board: FamilyId): void;
  takeUp(id: number): void;
  /** Adds a robot under a unique name. False if it is refused; then a notice says why. */
  add(label: Label, robot: Robot): boolean;
  /** False if the result would be invalid; then a notice says why. */
  edit(label: Label, change: (robot: Robot) => Robot): boolean;
  duplicate(): void;
  remove(id: number): void;
  undo(): void;
  redo(): void;
  /** Why the current robot may not be changed now, as a sentence, or null. `next`: the changed robot, if values of it change. */
  refusal(next?: Robot): string | null;
  /** Sets the function behind `refusal`. */
  refuseBy(refusal: (before: Robot, next: Robot | null) => string | null): void;
  /** Takes a robot from the library, null for a new one; returns its id. An undo step only if it replaces local changes. */
  takeIn(id: number | null, robot: Robot): number;
  /** Removes a robot that was deleted in the library. */
  drop(id: number): void;
}

const KEY = 'servodeck.robots';
const REPLACED_KEY = 'servodeck.robots.unreadable';

export function createRobots(storage: TextStorage, notices: Notices): RobotStore {
  const store = createStore<History<Robots>>(() => startHistory(load(storage, notices)));
  const present = (): Robots => store.getState().present;

  function change(next: History<Robots>): void {
    store.setState(next, true);
    try {
      storage.setItem(KEY, toText(next.present));
    } catch {
      notices.show('warning', words.robots.notSaved);
    }
  }

  const step = (label: Label, next: Robots): void => change(record(store.getState(), label, next));

  /** Choosing a robot is no undo step. */
  const silently = (next: Robots): void => change({ ...commit(store.getState()), present: next });

  const current = (): OwnRobot => currentOf(present());
  let refuse: (before: Robot, next: Robot | null) => string | null = () => null;
  const refusal = (next?: Robot): string | null => refuse(current().robot, next ?? null);

  /** Loads the sentences on demand: edits are rarely refused. */
  function tellFlaw(flaw: RobotFlaw): void {
    void import('../../i18n/robotFlaws.ts').then(
      ({ robotFlawSentence }) => notices.show('warning', robotFlawSentence(flaw)),
      notices.showError,
    );
  }

  /** Shows a notice. */
  function isRefused(next?: Robot): boolean {
    const why = refusal(next);
    if (why !== null) notices.show('warning', why);
    return why !== null;
  }

  function takeIn(id: number | null, robot: Robot): number {
    const history = commit(store.getState());
    if (id === null) {
      const fresh = unusedId(history);
      change(
        rebase(history, (robots) => ({ ...withRobot(robots, robot, fresh), currentId: robots.currentId })),
      );
      return fresh;
    }
    const before = robotIn(present(), id);
    const isTouched = valuesOf(history).some((value) => robotIn(value, id) !== before);
    const next = (robots: Robots): Robots => replaced(robots, id, robot);
    if (isTouched) change(record(history, () => words.robots.steps.elsewhere, next(history.present)));
    else change(rebase(history, next));
    return id;
  }

  return {
    store,
    current,
    takeUpFor(board) {
      if (current().robot.board === board) return;
      const { own } = present();
      const known = own.findLast(({ robot }) => robot.board === board);
      if (known !== undefined) silently({ ...present(), currentId: known.id });
      else silently(withRobot(present(), freshRobot(usualRobot(board), board)));
    },
    takeUp(id) {
      const chosen = (robots: Robots): Robots =>
        robotIn(robots, id) === undefined ? robots : { ...robots, currentId: id };
      // Undoing an earlier step does not choose another robot.
      if (id !== present().currentId) change(rebase(commit(store.getState()), chosen));
    },
    add(label, robot) {
      if (isRefused()) return false;
      step(label, withRobot(present(), { ...robot, name: unusedName(present(), robot.name) }));
      return true;
    },
    edit(label, edit) {
      const { id, robot } = current();
      const next = edit(robot);
      const flaw = flawOf(next);
      if (flaw !== null) tellFlaw(flaw);
      if (flaw !== null || (next !== robot && isRefused(next))) return false;
      if (next !== robot) step(label, replaced(present(), id, next));
      return true;
    },
    duplicate() {
      if (isRefused()) return;
      const { robot } = current();
      step(
        () => words.robots.steps.duplicate,
        withRobot(present(), {
          ...robot,
          name: unusedName(present(), words.robots.copyOf({ name: robot.name })),
        }),
      );
    },
    remove(id) {
      const own = present().own.filter((one) => one.id !== id);
      const next = own.at(-1);
      if (next === undefined || isRefused()) return;
      const { currentId } = present();
      step(() => words.robots.steps.remove, {
        ...present(),
        own,
        currentId: currentId === id ? next.id : currentId,
      });
    },
    undo: () => change(undo(store.getState())),
    redo: () => change(redo(store.getState())),
    refusal,
    refuseBy: (refusedBy) => (refuse = refusedBy),
    takeIn,
    drop(id) {
      const history = commit(store.getState());
      change(rebase(history, (robots) => without(robots, id, unusedId(history))));
    },
  };
}

const valuesOf = ({ past, present, future }: History<Robots>): readonly Robots[] => [
  present,
  ...[...past, ...future].map(({ value }) => value),
];

/** An id that occurs in no step of the history, so that undo cannot reuse one. */
const unusedId = (history: History<Robots>): number =>
  Math.max(...valuesOf(history).map(({ nextId }) => nextId));

/** The name with the first number that makes it unique, within the allowed length. */
function unusedName({ own }: Robots, name: string): string {
  const names = new Set(own.map(({ robot }) => robot.name));
  let found = name.slice(0, NAME_LENGTH).trim();
  for (let number = 2; names.has(found); number += 1)
    found = longerName(name, (some) => words.robots.numbered({ ...some, number }));
  return found;
}

const robotIn = ({ own }: Robots, id: number): Robot | undefined => own.find((one) => one.id === id)?.robot;

/** There is always a robot: the last one is replaced by a new usual one. */
function without(robots: Robots, id: number, unused: number): Robots {
  const gone = robotIn(robots, id);
  if (gone === undefined) return robots;
  const own = robots.own.filter((one) => one.id !== id);
  const last = own.at(-1);
  if (last === undefined)
    return withRobot({ ...robots, own }, freshRobot(usualRobot(gone.board), gone.board), unused);
  return { ...robots, own, currentId: robots.currentId === id ? last.id : robots.currentId };
}

export function currentOf({ own, currentId }: Robots): OwnRobot {
  const found = own.find(({ id }) => id === currentId) ?? own[0];
  if (found === undefined) throw new Error('there is always one robot');
  return found;
}

export function freshRobot(id: ReadyRobotId, board: FamilyId): Robot {
  return readyRobot(id, board, robotNames(id));
}

function withRobot({ own, nextId }: Robots, robot: Robot, id = nextId): Robots {
  return { own: [...own, { id, robot }], currentId: id, nextId: id + 1 };
}

/** True if the robot is unchanged since it was made for its board. */
export function isUsual(robot: Robot): boolean {
  return robotToText(robot) === robotToText(freshRobot(usualRobot(robot.board), robot.board));
}

function replaced(robots: Robots, id: number, robot: Robot): Robots {
  return { ...robots, own: robots.own.map((one) => (one.id === id ? { id, robot } : one)) };
}

function toText({ own, currentId, nextId }: Robots): string {
  const files = own.map(({ id, robot }) => ({ id, file: robotToText(robot) }));
  return JSON.stringify({ files, currentId, nextId });
}

function load(storage: TextStorage, notices: Notices): Robots {
  const fresh: Robots = { own: [{ id: 1, robot: freshRobot('arm', 'doc') }], currentId: 1, nextId: 2 };
  try {
    const text = storage.getItem(KEY);
    if (text === null) return fresh;
    const robots = fromText(text);
    if (robots !== null) return robots;
    storage.setItem(REPLACED_KEY, text);
    notices.show('warning', words.robots.unreadable);
  } catch {
    notices.show('warning', words.robots.notSaved);
  }
  return fresh;
}

/** null if the text was not written by this store. */
function fromText(text: string): Robots | null {
  try {
    const { files, currentId, nextId } = JSON.parse(text) as {
      files: { id: number; file: string }[];
      currentId: number;
      nextId: number;
    };
    const own = files.map(({ id, file }) => {
      const read = robotFromText(file);
      if (!Number.isSafeInteger(id) || 'problem' in read) throw new Error('not one of ours');
      return { id, robot: read.robot };
    });
    if (own.length === 0 || ![currentId, nextId].every(Number.isSafeInteger)) return null;
    return { own, currentId, nextId };
  } catch {
    return null;
  }
}
