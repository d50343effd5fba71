// Which groups go to which robots: each group in its slot, compiled once for all robots that take the same frames; what does not fit and
// what is replaced. Pure.

import { compile } from '#shared/group/compile.ts';
import { holdsMotion, maxErrorOf, type ActionGroup } from '#shared/group/group.ts';
import { slotFor } from '#shared/group/slotPlaces.ts';
import { EMPTY_SLOT_BOOK } from '#shared/group/slotBook.ts';
import { onBoard } from '#shared/profile/robot.ts';
import type { Range } from '#shared/codec/families.ts';
import type { FleetDownloadWish, FleetRobot } from '#shared/client/http.generated.ts';
import { boardName } from '../i18n/sentences.ts';
import { familyOf, robotOf } from './boards.ts';

/** A group of the library that a person has chosen. */
export interface Picked {
  readonly id: string;
  readonly group: ActionGroup;
  readonly slot: number;
}

/** What is said of one of them before it is sent. */
export interface PickedFacts {
  readonly isEmpty: boolean;
  /** Another one has the same slot. */
  readonly isSlotTwice: boolean;
  /** The names of the boards that cannot take it. */
  readonly refusedBy: readonly string[];
  /** The names of the robots of which it replaces another group. */
  readonly replacesOn: readonly string[];
}

type Body = FleetDownloadWish['groups'][number];

/** The slots that all of these boards have. */
export function slotRangeOf(robots: readonly FleetRobot[]): Range {
  const ranges = robots.map(({ board }) => familyOf(board).slot);
  return { min: Math.max(...ranges.map(({ min }) => min)), max: Math.min(...ranges.map(({ max }) => max)) };
}

/** The slot that the group names, or in which one of the robots has it already; else the next one that is free on all of them. */
export function slotOffered(
  { name, slot }: Pick<ActionGroup, 'name' | 'slot'>,
  robots: readonly FleetRobot[],
  taken: readonly number[],
): number {
  const range = slotRangeOf(robots);
  const stored = robots.flatMap(({ slots }) => slots);
  const isPossible = (one: number): boolean => one >= range.min && one <= range.max && !taken.includes(one);
  const own = slot ?? stored.find((one) => one.name === name)?.slot ?? null;
  const versions = Object.fromEntries(stored.map((one) => [one.slot, { version: '', documentId: null }]));
  const known = { book: EMPTY_SLOT_BOOK, versions, broken: [], range };
  return slotFor(own !== null && isPossible(own) ? own : null, known, taken);
}

/** One wish for all robots that take the same frames. Groups that do not fit a robot are left out of its wish. */
export function wishesFor(
  picked: readonly Picked[],
  robots: readonly FleetRobot[],
): readonly FleetDownloadWish[] {
  const byFrames = new Map<string, FleetDownloadWish>();
  for (const robot of robots) {
    const groups = picked.flatMap(({ group, slot }) => {
      const frames = framesFor(group, robot);
      return frames === null ? [] : [{ slot, name: group.name, frames }];
    });
    if (groups.length === 0) continue;
    const key = JSON.stringify(groups);
    const wish = byFrames.get(key) ?? { robots: [], groups };
    byFrames.set(key, { ...wish, robots: [...wish.robots, robot.id] });
  }
  return [...byFrames.values()];
}

export function factsOf(one: Picked, picked: readonly Picked[], robots: readonly FleetRobot[]): PickedFacts {
  const { group, slot } = one;
  const isEmpty = !holdsMotion(group);
  const refusing = isEmpty ? [] : robots.filter((robot) => framesFor(group, robot) === null);
  const replaced = robots.filter(
    (robot) =>
      !refusing.includes(robot) &&
      robot.slots.some((stored) => stored.slot === slot && stored.name !== group.name),
  );
  return {
    isEmpty,
    isSlotTwice: picked.some((other) => other !== one && other.slot === slot),
    refusedBy: [...new Set(refusing.map(({ board }) => boardName(familyOf(board))))],
    replacesOn: replaced.map(({ name }) => name),
  };
}

const compiled = new WeakMap<ActionGroup, Map<string, Body['frames'] | null>>();

/** Null where such a board cannot take the group. Remembered: the page draws a fleet again and again. */
function framesFor(group: ActionGroup, robot: FleetRobot): Body['frames'] | null {
  const known = compiled.get(group) ?? new Map<string, Body['frames'] | null>();
  compiled.set(group, known);
  const key = JSON.stringify([robot.board, robot.limits]);
  if (!known.has(key)) known.set(key, compileFor(group, robot));
  return known.get(key) ?? null;
}

function compileFor(group: ActionGroup, robot: FleetRobot): Body['frames'] | null {
  const family = familyOf(robot.board);
  const own = robotOf(robot);
  const { frames, report } = compile(group, {
    family,
    robot: own,
    maxErrorUnits: maxErrorOf(group, family),
  });
  if (frames.length === 0 || report.problems.some(({ kind }) => kind !== 'tooFast')) return null;
  return frames.map(({ durationMs, targets }) => ({
    durationMs,
    positions: Object.fromEntries(onBoard(own, targets).map(({ servo, position }) => [servo, position])),
  }));
}
