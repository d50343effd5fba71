// Where a robot may touch itself or the floor during a motion: links as primitive solids, swept through the poses in steps that depend on
// how near they are (conservative advancement). An estimate: sizes are those of the model, not of the robot. Knows no board and no page.

import { createPosing, type LinkModel, type Posing } from './model.ts';
import { type Meeting, meetingsOf, type Posture, postureOf } from './meetings.ts';

/** At that time each servo is at that angle; between two of them all turn evenly. */
export interface TimedAngles {
  readonly atMs: number;
  /** Radians by servo; the others are at 0. */
  readonly angles: ReadonlyMap<number, number>;
}

/** Of links that the same servos turn, those that meet first. */
export interface CollisionPlace extends Pick<Meeting, 'kind' | 'links' | 'servos'> {
  readonly fromMs: number;
  readonly toMs: number;
}

/** Near each other, links move no farther between two looks, so that what is missed is less deep. Millimetres. */
export const STEP_MM = 2;
/** While they overlap, only when they part is of interest. Millimetres. */
const OVERLAP_STEP_MM = 5;
/** Two places of the same links with less between them are one. Milliseconds. */
const SAME_PLACE_MS = 150;
/** A look that is due when this share of its time is left is taken with another one: a pose costs more than to compare two links. */
const SHARES_LOOK = 0.35;

const MM = 1000;

/** Goes through the motion; yields now and then, so that the caller can pause or end. In the order in which they begin. */
export function* collisions(
  model: LinkModel,
  motion: readonly TimedAngles[],
): Generator<void, readonly CollisionPlace[], void> {
  const pose = createPosing(model);
  const meetings = meetingsOf(model, pose);
  const watches = meetings.map(watchOf);
  const [first] = motion;
  if (first === undefined || watches.length === 0) return [];
  const posture = postureOf(pose(angleIn(first)));
  for (const watch of watches) look(watch, posture, first.atMs);
  for (const [index, from] of motion.entries()) {
    const to = motion[index + 1];
    if (to === undefined) break;
    yield* sweep(watches, pose, from, to);
  }
  const endMs = motion.at(-1)?.atMs ?? first.atMs;
  return placesOf(watches.map((watch) => ({ ...watch.meeting, spans: spansOf(watch, endMs) })));
}

/** All at once. */
export function collisionsOf(model: LinkModel, motion: readonly TimedAngles[]): readonly CollisionPlace[] {
  const run = collisions(model, motion);
  for (;;) {
    const { done, value } = run.next();
    if (done === true) return value;
  }
}

const angleIn =
  ({ angles }: TimedAngles) =>
  (servo: number): number =>
    angles.get(servo) ?? 0;

// Looking at a meeting as seldom as its gap allows.

interface Watch {
  readonly meeting: Meeting;
  readonly spans: Span[];
  /** Since when they touch; null: they do not. */
  touchedMs: number | null;
  lookedMs: number;
  /** So far it may still move before the next look, in metres. */
  roomM: number;
  /** In metres a millisecond at most, in the motion under way. */
  speed: number;
  nextMs: number;
}

interface Span {
  readonly fromMs: number;
  readonly toMs: number;
}

const watchOf = (meeting: Meeting): Watch => ({
  ...{ meeting, spans: [], touchedMs: null, lookedMs: 0, roomM: 0, speed: 0, nextMs: 0 },
});

function look(watch: Watch, posture: Posture, atMs: number): void {
  const gapM = watch.meeting.gapM(posture);
  watch.lookedMs = atMs;
  watch.roomM = gapM <= 0 ? OVERLAP_STEP_MM / MM : Math.max(gapM, STEP_MM / MM);
  if (gapM <= 0) watch.touchedMs ??= atMs;
  else if (watch.touchedMs !== null) {
    watch.spans.push({ fromMs: watch.touchedMs, toMs: atMs });
    watch.touchedMs = null;
  }
}

/** From one pose to the next. */
function* sweep(
  watches: readonly Watch[],
  pose: Posing,
  from: TimedAngles,
  to: TimedAngles,
): Generator<void, void, void> {
  const durationMs = to.atMs - from.atMs;
  if (durationMs <= 0) return;
  for (const watch of watches) watch.speed = speedOf(watch.meeting, from, to) / durationMs;
  const moving = watches.filter(({ speed }) => speed > 0);
  for (const watch of moving) schedule(watch);
  for (let looks = 1; ; looks++) {
    const nextMs = moving.reduce((soonest, watch) => Math.min(soonest, watch.nextMs), Infinity);
    if (nextMs >= to.atMs) break;
    const atMs = Math.max(nextMs, from.atMs);
    const posture = postureOf(pose(between(from, to, (atMs - from.atMs) / durationMs)));
    for (const watch of moving) {
      if (watch.nextMs > atMs + (watch.nextMs - watch.lookedMs) * SHARES_LOOK) continue;
      look(watch, posture, atMs);
      schedule(watch);
    }
    if (looks % LOOKS_EACH === 0) yield;
  }
  for (const watch of watches) {
    watch.roomM = Math.max(0, watch.roomM - watch.speed * (to.atMs - watch.lookedMs));
    watch.lookedMs = to.atMs;
  }
  yield;
}

/** About a millisecond's work. */
const LOOKS_EACH = 20;

const between =
  (from: TimedAngles, to: TimedAngles, share: number) =>
  (servo: number): number => {
    const [before, after] = [from.angles.get(servo) ?? 0, to.angles.get(servo) ?? 0];
    return before + (after - before) * share;
  };

/** In metres over the whole way, at most. */
function speedOf({ leverM }: Meeting, from: TimedAngles, to: TimedAngles): number {
  let sum = 0;
  for (const [servo, lever] of leverM)
    sum += lever * Math.abs((to.angles.get(servo) ?? 0) - (from.angles.get(servo) ?? 0));
  return sum;
}

function schedule(watch: Watch): void {
  const { speed, lookedMs, roomM } = watch;
  watch.nextMs = lookedMs + roomM / speed;
}

function spansOf({ spans, touchedMs }: Watch, endMs: number): readonly Span[] {
  return touchedMs === null ? spans : [...spans, { fromMs: touchedMs, toMs: endMs }];
}

/** When anything touches, in milliseconds; places that overlap in time are one. `places`: in the order in which they begin. */
export function collisionTimes(places: readonly Span[]): readonly Span[] {
  const times: Span[] = [];
  for (const { fromMs, toMs } of places) {
    const before = times.at(-1);
    if (before === undefined || fromMs > before.toMs) times.push({ fromMs, toMs });
    else times[times.length - 1] = { ...before, toMs: Math.max(before.toMs, toMs) };
  }
  return times;
}

// From meetings to places: links that the same servos turn are one to a person.

type Met = Pick<Meeting, 'kind' | 'links' | 'servos'> & { readonly spans: readonly Span[] };

function placesOf(met: readonly Met[]): readonly CollisionPlace[] {
  const bySubject = new Map<string, CollisionPlace[]>();
  for (const { kind, links, servos, spans } of met) {
    const subject = `${kind} ${servos.join(' ')}`;
    const places = bySubject.get(subject) ?? [];
    places.push(...spans.map((span) => ({ ...span, kind, links, servos })));
    bySubject.set(subject, places);
  }
  return [...bySubject.values()].flatMap(merged).toSorted(inTime);
}

const inTime = (one: Span, other: Span): number => one.fromMs - other.fromMs || one.toMs - other.toMs;

function merged(places: readonly CollisionPlace[]): readonly CollisionPlace[] {
  const joined: CollisionPlace[] = [];
  for (const place of places.toSorted(inTime)) {
    const before = joined.at(-1);
    if (before === undefined || place.fromMs > before.toMs + SAME_PLACE_MS) joined.push(place);
    else joined[joined.length - 1] = { ...before, toMs: Math.max(before.toMs, place.toMs) };
  }
  return joined;
}
