// How far two convex solids are apart: boxes, cylinders, spheres and hulls of points, or a capsule as a line with a radius. By Gilbert, Johnson and
// Keerthi: the point of the difference of both that is nearest to the origin. Metres. Knows no robot.

import {
  cross,
  dot,
  lengthOf,
  minus,
  rotated,
  rotatedBack,
  scaled,
  type Vec3,
  type LinkShape,
  type Place,
} from './model.ts';

/** A core without its rounding; a sphere is a point, a capsule a line. */
export interface Solid {
  readonly core: 'box' | 'cylinder' | 'hull';
  /** Box: half of x, y and z. Cylinder: its radius twice, half its length. */
  readonly half: Vec3;
  /** Of a hull. */
  readonly corners: readonly Vec3[];
  readonly roundM: number;
  /** From its middle to its farthest point. */
  readonly radiusM: number;
}

export interface PlacedSolid {
  readonly solid: Solid;
  readonly place: Place;
}

export function solidOf({ shape, size }: Pick<LinkShape, 'shape' | 'size'>): Solid {
  const [x = 0, y = 0, z = 0] = size;
  if (shape === 'hull') return hull(size);
  if (shape === 'sphere') return solid('box', [0, 0, 0], x);
  if (shape === 'cylinder') return solid('cylinder', [x, x, y / 2], 0);
  return solid('box', [x / 2, y / 2, z / 2], 0);
}

/** A line along z with a radius. */
export const capsule = (lengthM: number, radiusM: number): Solid =>
  solid('box', [0, 0, lengthM / 2], radiusM);

function solid(core: Solid['core'], half: Vec3, roundM: number): Solid {
  const [x, y, z] = half;
  const radiusM = (core === 'cylinder' ? Math.hypot(x, z) : Math.hypot(x, y, z)) + roundM;
  return { core, half, corners: [], roundM, radiusM };
}

function hull(size: readonly number[]): Solid {
  const corners = Array.from({ length: Math.floor(size.length / 3) }, (_, index): Vec3 => {
    const [x = 0, y = 0, z = 0] = size.slice(3 * index, 3 * index + 3);
    return [x, y, z];
  });
  return {
    core: 'hull',
    half: [0, 0, 0],
    corners,
    roundM: 0,
    radiusM: Math.max(0, ...corners.map(lengthOf)),
  };
}

/** How far its lowest point is above the plane z = 0, in metres; below 0 where it goes through. */
export const heightOf = (one: PlacedSolid): number => supportOf(one, [0, 0, -1])[2] - one.solid.roundM;

/** The point of the core that is farthest in a direction. */
function supportOf({ solid, place: { at, rotation } }: PlacedSolid, direction: Vec3): Vec3 {
  const [ox, oy, oz] = rotated(rotation, farthestOf(solid, rotatedBack(rotation, direction)));
  return [at[0] + ox, at[1] + oy, at[2] + oz];
}

function farthestOf({ core, half, corners }: Solid, direction: Vec3): Vec3 {
  const [x, y, z] = direction;
  if (core === 'box') return [Math.sign(x) * half[0], Math.sign(y) * half[1], Math.sign(z) * half[2]];
  if (core === 'cylinder') return [...onRim(x, y, half[0]), Math.sign(z) * half[2]];
  let farthest = corners[0] ?? half;
  let most = dot(farthest, direction);
  for (const corner of corners) {
    const far = dot(corner, direction);
    if (far <= most) continue;
    farthest = corner;
    most = far;
  }
  return farthest;
}

function onRim(x: number, y: number, radius: number): [number, number] {
  const length = Math.sqrt(x * x + y * y);
  return length === 0 ? [0, 0] : [(x / length) * radius, (y / length) * radius];
}

/** Nearer than this to the exact answer, in metres: a hundredth of a millimetre. */
export const ACCURACY_M = 1e-5;
const MOST_ROUNDS = 40;

/**
 * In metres, less than the exact answer by no more than `ACCURACY_M`, or by this share of it; 0 or less where they touch or overlap, which
 * is not how deep they do.
 */
export function distanceM(one: PlacedSolid, other: PlacedSolid, share = 0): number {
  const roundM = one.solid.roundM + other.solid.roundM;
  let nearest = minus(one.place.at, other.place.at);
  let simplex: readonly Vec3[] = [];
  for (let round = 0; round < MOST_ROUNDS; round++) {
    const length = lengthOf(nearest);
    if (length <= ACCURACY_M) return -roundM;
    const corner = minus(supportOf(one, scaled(nearest, -1)), supportOf(other, nearest));
    // No point of the difference is nearer than this plane.
    const atLeastM = dot(nearest, corner) / length - roundM;
    const atMostM = length - roundM;
    if (atMostM - atLeastM <= Math.max(ACCURACY_M, atLeastM * share)) return atLeastM;
    const next = nearestOf([...simplex, corner]);
    if (next === null) return -roundM;
    if (simplex.length > 0 && lengthOf(next.point) >= length) return atMostM;
    nearest = next.point;
    simplex = next.simplex;
  }
  return lengthOf(nearest) - roundM;
}

interface Nearest {
  readonly point: Vec3;
  /** The corners that it lies between. */
  readonly simplex: readonly Vec3[];
}

/** The point of a simplex that is nearest to the origin; null where the origin is inside. */
function nearestOf(corners: readonly Vec3[]): Nearest | null {
  const [a, b, c, d] = corners;
  if (a === undefined) return null;
  if (b === undefined) return { point: a, simplex: [a] };
  if (c === undefined) return onSegment(a, b);
  if (d === undefined) return onTriangle(a, b, c);
  return onTetrahedron(a, b, c, d);
}

function onSegment(a: Vec3, b: Vec3): Nearest {
  const along = minus(b, a);
  const square = dot(along, along);
  const share = square === 0 ? 0 : -dot(a, along) / square;
  if (share <= 0) return { point: a, simplex: [a] };
  if (share >= 1) return { point: b, simplex: [b] };
  return { point: plus(a, along, share), simplex: [a, b] };
}

/** By the regions of a triangle: its corners, its edges, its face. */
function onTriangle(a: Vec3, b: Vec3, c: Vec3): Nearest {
  const normal = cross(minus(b, a), minus(c, a));
  const square = dot(normal, normal);
  const edges = [
    [a, b],
    [b, c],
    [c, a],
  ] as const;
  const isInside = edges.every(([from, to]) => dot(cross(minus(to, from), scaled(from, -1)), normal) >= 0);
  if (isInside && square > 0) return { point: scaled(normal, dot(a, normal) / square), simplex: [a, b, c] };
  return nearer(edges.map(([from, to]) => onSegment(from, to)));
}

function onTetrahedron(a: Vec3, b: Vec3, c: Vec3, d: Vec3): Nearest | null {
  const faces = [
    [a, b, c, d],
    [a, c, d, b],
    [a, d, b, c],
    [b, d, c, a],
  ] as const;
  const outside = faces.filter(([from, to, third, opposite]) => {
    const normal = cross(minus(to, from), minus(third, from));
    // On the other side of the face than the fourth corner; of a flat one no side is known.
    return -dot(from, normal) * dot(minus(opposite, from), normal) <= 0;
  });
  return outside.length === 0
    ? null
    : nearer(outside.map(([from, to, third]) => onTriangle(from, to, third)));
}

const nearer = (found: readonly Nearest[]): Nearest =>
  found.reduce((best, one) => (dot(one.point, one.point) < dot(best.point, best.point) ? one : best));

const plus = (at: Vec3, along: Vec3, share: number): Vec3 => [
  at[0] + along[0] * share,
  at[1] + along[1] * share,
  at[2] + along[2] * share,
];
