// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change backend/servodeck/api/library.py instead.

export type Library = LibraryRequest | LibraryAnswer;
export type LibraryRequest = DocumentWrite | DocumentIds | VersionWrite;
export type LibraryAnswer = LibraryListing | StoredDocument | DocumentWritten | ListedVersion[] | VersionText;

/**
 * `expected` is the revision it was read at, 0 for a new one. With `isRemoved` it goes to the trash at
 * once: several that shall appear together are written so and then restored together.
 */
export interface DocumentWrite {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
  facts: GroupFacts | RobotFacts;
  expected: number;
  isRemoved: boolean;
}
/**
 * What a list says of an action group without reading it; `pose` is its picture.
 */
export interface GroupFacts {
  kind: 'group';
  name: string;
  robot: string;
  /**
   * @maxItems 20
   */
  tags: string[];
  updatedAtMs: number;
  frames: number;
  durationMs: number;
  unit: 'us' | 'steps';
  /**
   * @maxItems 256
   */
  pose: PoseTarget[];
}
export interface PoseTarget {
  servo: number;
  position: number;
}
/**
 * What the gateway itself needs to know of a robot: how far its servos may be turned and the poses that
 * programs go to, as the board counts.
 */
export interface RobotFacts {
  kind: 'robot';
  name: string;
  board: string;
  updatedAtMs: number;
  /**
   * @maxItems 253
   */
  limits: ServoLimits[];
  /**
   * @maxItems 1001
   */
  poses: NamedPose[];
}
/**
 * How far a servo may be turned, in its board's unit, and what people call it.
 */
export interface ServoLimits {
  servo: number;
  name: string;
  min: number;
  max: number;
}
/**
 * `id` stays when it is named anew. `targets` are some of the robot's servos, as its board counts.
 */
export interface NamedPose {
  id: number;
  name: string;
  unit: 'us' | 'steps';
  /**
   * @minItems 1
   * @maxItems 253
   */
  targets: PoseTarget[];
}
export interface DocumentIds {
  /**
   * @maxItems 5000
   */
  ids: string[];
}
export interface VersionWrite {
  name: string;
  atMs: number;
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
}
/**
 * `damagedFile` names a damaged file that was found and set apart; `changesLost`: the last changes before
 * the gateway's start may be missing.
 */
export interface LibraryListing {
  documents: ListedDocument[];
  damagedFile: string | null;
  changesLost: boolean;
}
export interface ListedDocument {
  id: string;
  revision: number;
  isRemoved: boolean;
  facts: GroupFacts | RobotFacts;
}
export interface StoredDocument {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
  revision: number;
}
export interface DocumentWritten {
  revision: number;
}
export interface ListedVersion {
  id: string;
  name: string;
  atMs: number;
}
export interface VersionText {
  /**
   * The document as JSON; only the page knows what it means.
   */
  text: string;
}
