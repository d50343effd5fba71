// How the servos of one robot are shown and handled on this screen: selected, locked, alone, armed, hidden, folded away, and how the
// selected ones move together. Pure values and edits; knows no motion.

export const TOGETHER = ['straight', 'mirrored', 'weighted'] as const;
/** `straight`: all turn the same way; `mirrored`: the others turn the other way; `weighted`: each by its own share. */
export type Together = (typeof TOGETHER)[number];

export interface ServoView {
  /** Numbers say nothing about another robot. */
  readonly robotId: number;
  /** In the order of selecting: the last one is the one at hand. */
  readonly selected: readonly number[];
  readonly locked: readonly number[];
  /** Not empty: all others are as if locked, and as if muted. */
  readonly solo: readonly number[];
  readonly hidden: readonly number[];
  /** Their keys stay in the group and move nothing from the page. */
  readonly muted: readonly number[];
  /** What a recording keeps; see `recorded`. */
  readonly armed: readonly number[];
  /** Groups of which only the header is shown. */
  readonly folded: readonly string[];
  readonly together: Together;
  /** In percent, 100 where left out. */
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
  folded: [],
  together: 'straight',
  weights: {},
};

export const INITIAL_SERVO_VIEW = FRESH;

/** What holds for this robot; fresh where the view is of another one. */
export function servoViewFor(view: ServoView, robotId: number): ServoView {
  return view.robotId === robotId ? view : FRESH;
}

/** Nothing of the servo panel moves it. */
export function isHeld({ locked, solo }: Pick<ServoView, 'locked' | 'solo'>, servo: number): boolean {
  return locked.includes(servo) || (solo.length > 0 && !solo.includes(servo));
}

/** Nothing of the group is sent to it from the page. */
export function isSilent({ muted, solo }: Pick<ServoView, 'muted' | 'solo'>, servo: number): boolean {
  return muted.includes(servo) || (solo.length > 0 && !solo.includes(servo));
}

/** Whose motion a recording keeps: of the armed servos, else of the selected ones, else of all. */
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

/** `adds` keeps the others, `spans` takes all from the last one on. Clicked again, a servo is let go. `order` is the screen's. */
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

/** Puts the servos into the list, or, where all are in it, takes them out. */
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
