// How fast compiled frames turn each servo, beside what it can do, and about how much current all of them take together; and whether they
// take less if the servos begin one after another. The first frame is left out: where the servos come from is not known. Knows no page.

import type { Frame } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { DEGREES_PER_UNIT } from '../profile/readyRobots.ts';
import { servoOf, type Robot } from '../profile/robot.ts';
import { compile } from './compile.ts';
import type { ActionGroup } from './group.ts';
import { stagger } from './keyEdits.ts';

/** Between two frames all servos turn evenly. */
export interface LoadSpan {
  readonly fromMs: number;
  readonly toMs: number;
  /** Degrees a second by servo; the others rest. */
  readonly speeds: ReadonlyMap<number, number>;
  /** Of all servos of the group together, in milliamperes: an estimate. */
  readonly currentMa: number;
}

export interface ServoLoad {
  readonly servo: number;
  /** In degrees a second. */
  readonly fastest: number;
  /** What it can do: its whole range in the time of the soft limit. */
  readonly limit: number;
}

export interface GroupLoad {
  readonly spans: readonly LoadSpan[];
  /** In the order of their numbers. */
  readonly servos: readonly ServoLoad[];
  readonly mostMa: number;
}

/**
 * Of one servo, in milliamperes: resting without a load, and beside that turning without a load as fast as it can. Typical figures of sellers for
 * metal gear servos of 55 g at 6 V (MG995: 5–10 resting, 200–300 turning; MG996R: up to 500 turning). A load takes more, up to 2.5 A where it
 * blocks the servo, and the start of a turn a short peak: the sum is a lower bound for a supply, not its rating.
 */
const CURRENT_MA = { rest: 10, turning: 500 };

interface LoadOptions {
  readonly robot: Robot;
  readonly family: Family;
  /** In which a servo goes over its whole range. */
  readonly rangeMs: number;
}

export function loadOf(frames: readonly Frame[], { robot, family, rangeMs }: LoadOptions): GroupLoad {
  const numbers = [...new Set(frames.flatMap(({ targets }) => targets.map(({ servo }) => servo)))].sort(
    (one, other) => one - other,
  );
  const degreesPerUnit = (servo: number): number =>
    servoOf(robot, servo)?.degreesPerUnit ?? DEGREES_PER_UNIT[family.unit];
  const { min, max } = family.position;
  const limits = new Map(
    numbers.map((servo) => [servo, ((max - min) * degreesPerUnit(servo) * 1000) / rangeMs]),
  );
  const at = new Map<number, number>();
  const fastest = new Map<number, number>();
  let fromMs = 0;
  const spans = frames.map(({ durationMs, targets }, index): LoadSpan => {
    const speeds = new Map<number, number>();
    for (const { servo, position } of targets) {
      const units = Math.abs(position - (at.get(servo) ?? position));
      at.set(servo, position);
      if (index === 0 || units === 0) continue;
      const speed = (units * degreesPerUnit(servo) * 1000) / durationMs;
      speeds.set(servo, speed);
      fastest.set(servo, Math.max(fastest.get(servo) ?? 0, speed));
    }
    const toMs = fromMs + durationMs;
    const span = { fromMs, toMs, speeds, currentMa: currentOf(numbers, speeds, limits) };
    fromMs = toMs;
    return span;
  });
  const known = spans.slice(1);
  return {
    spans: known,
    servos: numbers.map((servo) => ({
      servo,
      fastest: fastest.get(servo) ?? 0,
      limit: limits.get(servo) ?? Infinity,
    })),
    mostMa: known.reduce((most, { currentMa }) => Math.max(most, currentMa), 0),
  };
}

/** Proportional to the speed, up to what the servo can do. */
function currentOf(
  servos: readonly number[],
  speeds: ReadonlyMap<number, number>,
  limits: ReadonlyMap<number, number>,
): number {
  return servos.reduce((sum, servo) => {
    const share = Math.min(1, (speeds.get(servo) ?? 0) / (limits.get(servo) ?? Infinity));
    return sum + CURRENT_MA.rest + CURRENT_MA.turning * share;
  }, 0);
}

export interface Staggered {
  readonly group: ActionGroup;
  readonly stepMs: number;
  /** The most that all servos take together, before and after. */
  readonly beforeMa: number;
  readonly afterMa: number;
}

interface StaggerOptions extends LoadOptions {
  readonly maxErrorUnits: number;
  isFree(servo: number): boolean;
}

const STAGGER_STEPS_MS = [20, 40, 60, 80, 100, 150, 200, 300];
/** A peak that falls by less is not worth a longer group, nor one that falls so little more a longer step. */
const WORTHWHILE = 0.05;
/** Less is within the estimate. */
const LEAST_MA = 50;

/** The shortest step with about the lowest peak; null where none lowers it. */
export function staggered(
  group: ActionGroup,
  { maxErrorUnits, isFree, ...options }: StaggerOptions,
): Staggered | null {
  const mostOf = (one: ActionGroup): number =>
    loadOf(compile(one, { ...options, maxErrorUnits }).frames, options).mostMa;
  const beforeMa = mostOf(group);
  const tried = STAGGER_STEPS_MS.map((stepMs): Staggered => {
    const later = stagger(group, stepMs, isFree);
    return { group: later, stepMs, beforeMa, afterMa: mostOf(later) };
  });
  const lowest = Math.min(...tried.map(({ afterMa }) => afterMa));
  if (beforeMa - lowest < Math.max(LEAST_MA, beforeMa * WORTHWHILE)) return null;
  return tried.find(({ afterMa }) => afterMa <= lowest + beforeMa * WORTHWHILE) ?? null;
}
