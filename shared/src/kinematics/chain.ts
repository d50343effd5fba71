// Joints in a row from a base to a tip, and where they are for given angles (forward kinematics). Metres and radians; frames, axes
// and roll-pitch-yaw as in URDF: x forward, y left, z up. Knows no servos, no limits of a board and no picture.

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
