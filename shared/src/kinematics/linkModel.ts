// A robot as a tree of links with primitive shapes, and where each link is for given angles of its servos. Metres and radians; frames,
// axes and roll-pitch-yaw as in URDF. Knows no picture and no board.

import {
  added,
  multiplied,
  NO_ROTATION,
  rotated,
  rotationAbout,
  rotationOfRpy,
  type Rotation,
  type Vec3,
} from './chain.ts';

/** In the frame of its link. */
export interface LinkShape {
  readonly shape: 'box' | 'cylinder' | 'sphere';
  /** Box: x, y, z. Cylinder: radius, length along z. Sphere: radius. */
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
