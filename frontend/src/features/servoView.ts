// How this screen shows and handles the servos of one robot: selected, locked, solo, armed, hidden, folded, and how selected servos
// move together. Pure values and edits; knows no motion.

import { stayingSentence, servoName } from '../i18n/sentences.ts';
import type { RobotStore } from './profiles/robots.ts';

export const TOGETHER = ['straight', 'mirrored', 'weighted'] as const;
/** `straight`: all turn the same way; `mirrored`: the others turn the other way; `weighted`: each by its own share. */
export type Together = (typeof TOGETHER)[number];

export interface ServoView {
  /** The servo numbers below belong to this robot only. */
  readonly robotId: number;
  /** In the order in which they were selected; the last one is the current servo. */
  readonly selected: readonly number[];
  readonly locked: readonly number[];
  /** If not empty, all other servos count as locked and muted. */
  readonly solo: readonly number[];
  readonly hidden: readonly number[];
  /** Their keyframes stay in the group; the page does not play them. */
  readonly muted: readonly number[];
  /** Servos that a recording stores; see `recorded`. */
  readonly armed: readonly number[];
  /** Servos that are recorded over the motion now; if not empty, the motion has all others, and they count as locked. */
  readonly overdubbed: readonly number[];
  /** Groups of which only the header is shown. */
  readonly folded: readonly string[];
  readonly together: Together;
  /** In percent; 100 if absent. */
  readonly weights: Readonly<Record<number, number>>;
}

const FRESH: ServoView = {
  robotId: 0,
  selected: [],
  locked: [],
  solo: [],
  hidden: [],
  muted: [],
  armed: [],
  overdubbed: [],
  folded: [],
  together: 'straight',
  weights: {},
};

export const INITIAL_SERVO_VIEW = FRESH;

/** `view` if it belongs to this robot, otherwise the initial view. */
export function servoViewFor(view: ServoView, robotId: number): ServoView {
  return view.robotId === robotId ? view : FRESH;
}

/** True if the controls of the servo panel must not move it. */
export function isHeld(
  { locked, solo, overdubbed }: Pick<ServoView, 'locked' | 'solo' | 'overdubbed'>,
  servo: number,
): boolean {
  return (
    locked.includes(servo) || [solo, overdubbed].some((only) => only.length > 0 && !only.includes(servo))
  );
}

/** True if playing from the page sends nothing to it. */
export function isSilent({ muted, solo }: Pick<ServoView, 'muted' | 'solo'>, servo: number): boolean {
  return muted.includes(servo) || (solo.length > 0 && !solo.includes(servo));
}

/** The servos that a recording stores: the armed ones, else the selected ones, else all. */
export function recorded(
  { armed, selected }: Pick<ServoView, 'armed' | 'selected'>,
  all: readonly number[],
): { readonly servos: readonly number[]; readonly by: 'armed' | 'selected' | 'all' } {
  if (armed.length > 0) return { servos: armed, by: 'armed' };
  return selected.length > 0 ? { servos: selected, by: 'selected' } : { servos: all, by: 'all' };
}

export function select(view: ServoView, selected: readonly number[]): ServoView {
  return { ...view, selected };
}

/** `adds` keeps the other servos, `spans` selects the range from the last one. A second click deselects. `order`: as on the screen. */
export function selectByClick(
  view: ServoView,
  servo: number,
  { adds, spans }: { readonly adds: boolean; readonly spans: boolean },
  order: readonly number[],
): ServoView {
  const { selected } = view;
  const last = selected.at(-1);
  if (spans && last !== undefined) return select(view, union(selected, between(order, last, servo), servo));
  const others = selected.filter((one) => one !== servo);
  const isLetGo = selected.includes(servo) && (adds || others.length === 0);
  return select(view, [...(adds ? others : []), ...(isLetGo ? [] : [servo])]);
}

/** Adds the items to the list, or removes them if the list has all of them. */
export function toggled<T>(list: readonly T[], wanted: readonly T[]): readonly T[] {
  const others = list.filter((one) => !wanted.includes(one));
  return wanted.every((one) => list.includes(one)) ? others : [...others, ...wanted];
}

function between(order: readonly number[], one: number, other: number): readonly number[] {
  const [from, to] = [order.indexOf(one), order.indexOf(other)].toSorted((a, b) => a - b);
  return order.slice(from, (to ?? 0) + 1);
}

function union(selected: readonly number[], span: readonly number[], last: number): readonly number[] {
  return [...new Set([...selected, ...span])].filter((one) => one !== last).concat(last);
}

export interface Locking {
  readonly view: { getState(): { readonly servos: ServoView } };
  readonly robots: Pick<RobotStore, 'current'>;
}

export function isLocked({ view, robots }: Locking, servo: number): boolean {
  return isHeld(servoViewFor(view.getState().servos, robots.current().id), servo);
}

export function freeOf<Target extends { readonly servo: number }>(
  locking: Locking,
  targets: readonly Target[],
): readonly Target[] {
  return targets.filter(({ servo }) => !isLocked(locking, servo));
}

/** A sentence that names the locked servos among the targets; null if there are none. */
export function stayingOf(locking: Locking, targets: readonly { readonly servo: number }[]): string | null {
  const { robot } = locking.robots.current();
  const names = targets
    .filter(({ servo }) => isLocked(locking, servo))
    .map(({ servo }) => servoName(robot, servo));
  return names.length === 0 ? null : stayingSentence(names);
}
