// What of a robot can meet: two of its links, or a link and the floor; how near they are in a pose, and how far they move for each
// radian of a servo at most. Neighbours and what one servo moves against each other are left out. Metres. Knows no time.

import {
  lengthOf,
  minus,
  rotationOfRpy,
  type Vec3,
  BASE_PLACE,
  type LinkModel,
  type ModelLink,
  type Place,
  placeOn,
  type Posing,
} from './model.ts';
import { distanceM, heightOf, type PlacedSolid, solidOf } from './distance.ts';

/** Links that are nearer than this at home are built so, and are not judged. In metres. */
const HOME_M = 0.001;
/** Of what is far away it is enough to know about how far. */
const SHARE = 0.1;

export interface Meeting {
  readonly kind: 'self' | 'floor';
  /** Names: those that meet, or the one that meets the floor. */
  readonly links: readonly string[];
  /** The servo that turns each of them; null: it is part of the base. */
  readonly servos: readonly (number | null)[];
  /** How far a point of them moves for each radian of a servo at most, in metres. */
  readonly leverM: ReadonlyMap<number, number>;
  /** How far they are apart in metres, or less than that; 0 or below where they touch. */
  gapM(posture: Posture): number;
}

/** A pose of the model: what it takes to compare its links, each worked out at most once. */
export interface Posture {
  placeOf(part: Part): Place;
  solidsOf(part: Part): readonly PlacedSolid[];
}

export function postureOf(places: readonly Place[]): Posture {
  const solids: (readonly PlacedSolid[] | undefined)[] = [];
  const placeOf = ({ index }: Part): Place => places[index] ?? BASE_PLACE;
  return {
    placeOf,
    solidsOf: (part) =>
      (solids[part.index] ??= part.solids.map(({ solid, place }) => ({
        solid,
        place: placeOn(placeOf(part), place),
      }))),
  };
}

interface Part {
  readonly index: number;
  readonly link: ModelLink;
  /** In the frame of the link. */
  readonly solids: readonly PlacedSolid[];
  /** From the origin of the link to its farthest point. */
  readonly reachM: number;
  /** The turning joints from the base on. */
  readonly turns: readonly Turn[];
}

interface Turn {
  readonly joint: string;
  readonly servo: number;
  /** Metres for each radian of the servo at most. */
  readonly leverM: number;
}

export function meetingsOf(model: LinkModel, pose: Posing): readonly Meeting[] {
  const parts = partsOf(model);
  const home = postureOf(pose(() => 0));
  const pairs = parts.flatMap((one, index) =>
    parts.slice(index + 1).flatMap((other) => pairOf(one, other) ?? []),
  );
  const floor = model.standsOnFloor ? parts.filter(({ turns }) => turns.length > 0).map(onFloor) : [];
  return [...pairs, ...floor].filter((meeting) => meeting.gapM(home) > HOME_M);
}

function partsOf({ links }: LinkModel): readonly Part[] {
  const byName = new Map(links.map((link) => [link.name, link]));
  return links.flatMap((link, index): readonly Part[] => {
    if (link.shapes.length === 0) return [];
    const solids = link.shapes.map((shape) => ({
      solid: solidOf(shape),
      place: { at: shape.at, rotation: rotationOfRpy(shape.rpy) },
    }));
    const reachM = Math.max(...solids.map(({ solid, place }) => lengthOf(place.at) + solid.radiusM));
    return [{ index, link, solids, reachM, turns: turnsOf(link, reachM, byName) }];
  });
}

function turnsOf(link: ModelLink, reachM: number, byName: ReadonlyMap<string, ModelLink>): readonly Turn[] {
  const turns: Turn[] = [];
  let fromJointM = reachM;
  for (let at: ModelLink | undefined = link; at?.mount; at = byName.get(at.mount.on)) {
    const { servo, share, at: origin } = at.mount;
    if (servo !== null) turns.unshift({ joint: at.name, servo, leverM: fromJointM * Math.abs(share) });
    fromJointM += lengthOf(origin);
  }
  return turns;
}

/** Null for neighbours, and for what one servo moves against each other: the jaws of a gripper are built to meet. */
function pairOf(one: Part, other: Part): Meeting | null {
  const between = [
    ...one.turns.filter(({ joint }) => other.turns.every((turn) => turn.joint !== joint)),
    ...other.turns.filter(({ joint }) => one.turns.every((turn) => turn.joint !== joint)),
  ];
  if (between.length < 2 || new Set(between.map(({ servo }) => servo)).size < 2) return null;
  return {
    kind: 'self',
    links: [one.link.name, other.link.name],
    servos: [servoOfPart(one), servoOfPart(other)],
    leverM: leversOf(between),
    gapM({ placeOf, solidsOf }) {
      const apartM = distanceBetween(placeOf(one).at, placeOf(other).at) - one.reachM - other.reachM;
      return apartM > 0 ? apartM : gapOfSolids(solidsOf(one), solidsOf(other));
    },
  };
}

function gapOfSolids(some: readonly PlacedSolid[], others: readonly PlacedSolid[]): number {
  let least = Infinity;
  for (const one of some) {
    for (const other of others) {
      const apartM = distanceBetween(one.place.at, other.place.at) - one.solid.radiusM - other.solid.radiusM;
      if (apartM < least) least = Math.min(least, apartM > 0 ? apartM : distanceM(one, other, SHARE));
    }
  }
  return least;
}

function onFloor(part: Part): Meeting {
  return {
    kind: 'floor',
    links: [part.link.name],
    servos: [servoOfPart(part)],
    leverM: leversOf(part.turns),
    gapM({ placeOf, solidsOf }) {
      const aboveM = placeOf(part).at[2] - part.reachM;
      return aboveM > 0 ? aboveM : Math.min(...solidsOf(part).map(heightOf));
    },
  };
}

function leversOf(turns: readonly Turn[]): ReadonlyMap<number, number> {
  const levers = new Map<number, number>();
  for (const { servo, leverM } of turns) levers.set(servo, (levers.get(servo) ?? 0) + leverM);
  return levers;
}

const servoOfPart = ({ turns }: Part): number | null => turns.at(-1)?.servo ?? null;

const distanceBetween = (one: Vec3, other: Vec3): number => lengthOf(minus(one, other));
