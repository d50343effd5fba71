// A document that each robot has one of: the store shows the one of the robot at hand, saves it under the robot's number,
// and changes it with the robot. Text that cannot be read is set aside, never thrown away. Never moves anything.

import { startHistory, type History } from '#shared/actions/history.ts';
import type { Robot } from '#shared/actions/robot/robot.ts';
import type { Read } from '#shared/actions/versionedText.ts';
import type { TextStorage } from './document.ts';
import type { Notices } from './notices.ts';
import type { OwnRobot, RobotStore } from './robots.ts';
import { createUndoable, type Undoable } from './undoable.ts';

export interface RobotDocumentOptions<T> {
  readonly storage: TextStorage;
  readonly notices: Notices;
  readonly robots: RobotStore;
  /** Before the robot's number in the storage's key. */
  readonly key: string;
  /** What a robot has that nothing was saved for. */
  fresh(robot: Robot): T;
  toText(value: T): string;
  fromText(text: string): Read<T>;
  /** What the person is told then. */
  notSaved(): string;
  unreadable(): string;
}

export function createRobotDocument<T>(options: RobotDocumentOptions<T>): Undoable<T> {
  const { storage, notices, robots, key, toText } = options;
  /** Histories of robots that are not at hand. */
  const aside = new Map<number, History<T>>();
  let owner = robots.current().id;

  const document = createUndoable(load(options, robots.current()), (present) => {
    try {
      storage.setItem(`${key}.${owner}`, toText(present));
    } catch {
      notices.tell('warning', options.notSaved());
    }
  });

  robots.store.subscribe(() => {
    const taken = robots.current();
    const { id } = taken;
    if (id === owner) return;
    document.commit();
    aside.set(owner, document.store.getState());
    owner = id;
    document.store.setState(aside.get(id) ?? startHistory(load(options, taken)), true);
  });
  return document;
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
    notices.tell('warning', options.unreadable());
  } catch {
    notices.tell('warning', options.notSaved());
  }
  return empty;
}
