// Joints in a row from a base to a tip, a robot as a tree of links with primitive shapes, and the place of each for given angles (forward
// kinematics). Metres and radians; frames, axes and roll-pitch-yaw as in URDF: x forward, y left, z up. Knows no servos, board or picture.

export type Vec3 = readonly [x: number, y: number, z: number];
/** Three rows of three. */
export type Rotation = readonly [Vec3, Vec3, Vec3];

export interface ChainJoint {
  readonly name: string;
  /** Where it sits in the frame of the joint before it. */
  readonly origin: Vec3;
  /** How it is turned there at an angle of 0. */
  readonly rotation: Rotation;
  /** A unit vector in its own frame. */
  readonly axis: Vec3;
  readonly min: number;
  readonly max: number;
}

export interface Chain {
  readonly joints: readonly ChainJoint[];
  /** In the frame of the last joint. */
  readonly tip: Vec3;
  /** A unit vector in the frame of the last joint: where a gripper points. */
  readonly pointing: Vec3;
}

/** All in the frame of the base. */
export interface ChainPose {
  readonly tip: Vec3;
  readonly pointing: Vec3;
  /** Where each joint sits and about what it turns. */
  readonly joints: readonly { readonly at: Vec3; readonly axis: Vec3 }[];
}

export const NO_ROTATION: Rotation = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** One angle a joint, in the order of the chain. */
export function poseOfChain({ joints, tip, pointing }: Chain, angles: readonly number[]): ChainPose {
  let at: Vec3 = [0, 0, 0];
  let rotation = NO_ROTATION;
  const posed = joints.map((joint, index) => {
    at = added(at, rotated(rotation, joint.origin));
    rotation = multiplied(rotation, joint.rotation);
    const axis = rotated(rotation, joint.axis);
    rotation = multiplied(rotation, rotationAbout(joint.axis, angles[index] ?? 0));
    return { at, axis };
  });
  return { tip: added(at, rotated(rotation, tip)), pointing: rotated(rotation, pointing), joints: posed };
}

/** Rodrigues' formula; the axis is a unit vector. */
export function rotationAbout([x, y, z]: Vec3, radians: number): Rotation {
  const [sin, cos] = [Math.sin(radians), Math.cos(radians)];
  const rest = 1 - cos;
  return [
    [cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin],
    [y * x * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin],
    [z * x * rest - y * sin, z * y * rest + x * sin, cos + z * z * rest],
  ];
}

export const added = (one: Vec3, other: Vec3): Vec3 => [
  one[0] + other[0],
  one[1] + other[1],
  one[2] + other[2],
];
export const minus = (one: Vec3, other: Vec3): Vec3 => [
  one[0] - other[0],
  one[1] - other[1],
  one[2] - other[2],
];
export const scaled = (vector: Vec3, by: number): Vec3 => [vector[0] * by, vector[1] * by, vector[2] * by];
export const dot = (one: Vec3, other: Vec3): number =>
  one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
export const cross = (one: Vec3, other: Vec3): Vec3 => [
  one[1] * other[2] - one[2] * other[1],
  one[2] * other[0] - one[0] * other[2],
  one[0] * other[1] - one[1] * other[0],
];
export const lengthOf = ([x, y, z]: Vec3): number => Math.sqrt(x * x + y * y + z * z);

export const rotated = (rotation: Rotation, vector: Vec3): Vec3 => [
  dot(rotation[0], vector),
  dot(rotation[1], vector),
  dot(rotation[2], vector),
];

/** The other way round. */
export const rotatedBack = ([x, y, z]: Rotation, [a, b, c]: Vec3): Vec3 => [
  x[0] * a + y[0] * b + z[0] * c,
  x[1] * a + y[1] * b + z[1] * c,
  x[2] * a + y[2] * b + z[2] * c,
];

export function multiplied(one: Rotation, other: Rotation): Rotation {
  const column = (index: 0 | 1 | 2): Vec3 => [other[0][index], other[1][index], other[2][index]];
  const columns: Rotation = [column(0), column(1), column(2)];
  return [rotated(columns, one[0]), rotated(columns, one[1]), rotated(columns, one[2])];
}

/** As URDF has it: about the fixed axes x, y and z, in this order. */
export function rotationOfRpy([roll, pitch, yaw]: Vec3): Rotation {
  const [x, y, z] = [
    rotationAbout([1, 0, 0], roll),
    rotationAbout([0, 1, 0], pitch),
    rotationAbout([0, 0, 1], yaw),
  ];
  return multiplied(z, multiplied(y, x));
}

/** In the frame of its link. */
export interface LinkShape {
  readonly shape: 'box' | 'cylinder' | 'sphere' | 'hull';
  /** Box: x, y, z. Cylinder: radius, length along z. Sphere: radius. Hull: x, y, z of each of its corners. */
  readonly size: readonly number[];
  readonly at: Vec3;
  readonly rpy: Vec3;
}

/** The joint that carries a link. */
export interface LinkMount {
  /** The name of a link that stands before this one in the model. */
  readonly on: string;
  readonly at: Vec3;
  readonly rpy: Vec3;
  /** A unit vector. */
  readonly axis: Vec3;
  /** The servo that turns it; null: it is fixed. */
  readonly servo: number | null;
  /** Its angle is that of the servo times this, plus the offset. */
  readonly share: number;
  readonly offset: number;
}

export interface ModelLink {
  readonly name: string;
  readonly shapes: readonly LinkShape[];
  /** Null for the base. */
  readonly mount: LinkMount | null;
}

export interface LinkModel {
  /** Each behind the one that carries it. */
  readonly links: readonly ModelLink[];
  /** The base stands on the floor and stays there; false for a body on legs, which rests on whatever is lowest. */
  readonly standsOnFloor: boolean;
}

/** A place in the frame of the base. */
export interface Place {
  readonly at: Vec3;
  readonly rotation: Rotation;
}

export const BASE_PLACE: Place = { at: [0, 0, 0], rotation: NO_ROTATION };

/** The frame of each link, in the order of the model, for the angle of each servo in radians. */
export type Posing = (angleOf: (servo: number) => number) => readonly Place[];

export function createPosing({ links }: LinkModel): Posing {
  const index = new Map(links.map(({ name }, at) => [name, at]));
  const joints = links.map(({ mount }) =>
    mount === null
      ? null
      : { ...mount, parent: index.get(mount.on) ?? 0, rotation: rotationOfRpy(mount.rpy) },
  );
  return (angleOf) => {
    const places: Place[] = [];
    for (const joint of joints) {
      const before = joint === null ? undefined : places[joint.parent];
      places.push(joint === null || before === undefined ? BASE_PLACE : jointPlace(before, joint, angleOf));
    }
    return places;
  };
}

function jointPlace(
  before: Place,
  { at, rotation, axis, servo, share, offset }: LinkMount & { readonly rotation: Rotation },
  angleOf: (servo: number) => number,
): Place {
  const mounted = placeOn(before, { at, rotation });
  if (servo === null) return mounted;
  const turn = rotationAbout(axis, angleOf(servo) * share + offset);
  return { at: mounted.at, rotation: multiplied(mounted.rotation, turn) };
}

/** What has a place in a frame, seen from where that frame is. */
export const placeOn = (frame: Place, { at, rotation }: Place): Place => ({
  at: added(frame.at, rotated(frame.rotation, at)),
  rotation: multiplied(frame.rotation, rotation),
});
