// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change backend/servodeck/fleet/drive_messages.py instead.

export type DriveMessage = DriveWish | DriveNews;
export type DriveWish = DriveBeat | DriveMove | DriveRun | DriveRequest | DriveRelease;
export type DriveNews = DriveLease | DriveLive | DriveRefused;

/**
 * The page is there: its answer to each report, with the nonce of that. The robot counts the beat from
 * when it issued the nonce, so one that was held up on the way is no sign of life.
 */
export interface DriveBeat {
  type: 'beat';
  nonce: string | null;
}
/**
 * As the `move` of a page at its own robot. `nonce`: the newest that the page has got.
 */
export interface DriveMove {
  type: 'move';
  /**
   * @minItems 1
   * @maxItems 253
   */
  targets: Target[];
  durationMs: number;
  /**
   * Of the latest `tick`: shows how old the message is.
   */
  nonce: string;
}
/**
 * The target of a servo, in its board's unit.
 */
export interface Target {
  servo: number;
  position: number;
}
/**
 * Run the group in `slot`, once.
 */
export interface DriveRun {
  type: 'run';
  slot: number;
  /**
   * Of the latest `tick`: shows how old the message is.
   */
  nonce: string;
}
/**
 * Request the lease again, after it was refused or has passed to somebody else.
 */
export interface DriveRequest {
  type: 'request';
}
/**
 * Give the lease back; the connection ends.
 */
export interface DriveRelease {
  type: 'release';
}
/**
 * `driver`: who has the lease; null for nobody and for an unknown one.
 */
export interface DriveLease {
  type: 'lease';
  lease: 'requested' | 'driving' | 'none';
  driver: string | null;
}
/**
 * The newest report of the robot, at most 20 a second while it is driven. `motion` is null where it was a
 * state, which has none.
 */
export interface DriveLive {
  type: 'live';
  /**
   * Of the latest `tick`: shows how old the message is.
   */
  nonce: string;
  latch: boolean;
  motion: MotionState | null;
}
/**
 * The moves of the servos since the port opened, and their reported positions; the position of a servo
 * without either is unknown. `runSlot`: the group that may run. `released`: they have no torque, so a person
 * may have turned them.
 */
export interface MotionState {
  servos: ServoWay[];
  runSlot: number | null;
  released: number[];
  reported: ReportedPosition[];
}
/**
 * A move of a servo, in progress or ended: the time since its start (below 0: not started yet), and its
 * duration. `start` is null where its position at the start is unknown. `goal`: where it goes on to in later
 * parts of its move, in `goal_within_ms`.
 */
export interface ServoWay {
  servo: number;
  start: number | null;
  target: number;
  begunMsAgo: number;
  durationMs: number;
  goal: number | null;
  goalWithinMs: number;
}
/**
 * The position that the board reported for a servo, with its age. `isCurrent`: as far as the gateway
 * knows, the servo has not moved since.
 */
export interface ReportedPosition {
  servo: number;
  position: number;
  ageMs: number;
  isCurrent: boolean;
}
/**
 * A wish was not carried out. `code` is null where no answer has come.
 */
export interface DriveRefused {
  type: 'refused';
  code:
    | (
        | 'closed'
        | 'lost'
        | 'portMissing'
        | 'portBusy'
        | 'portDenied'
        | 'hidDenied'
        | 'otherDevice'
        | 'boardUnknown'
        | 'wrongBoard'
        | 'echo'
        | 'boardSilent'
        | 'noAnswer'
        | 'notSupported'
        | 'notOnThisCable'
        | 'latched'
        | 'notDriving'
        | 'expired'
        | 'busy'
        | 'slotBroken'
        | 'slotChanged'
        | 'batteryLow'
        | 'cancelled'
        | 'outOfRange'
        | 'malformed'
        | 'forbidden'
        | 'notPaired'
        | 'pairingFailed'
        | 'pairingLocked'
        | 'wrongType'
        | 'notFound'
        | 'methodNotAllowed'
        | 'conflict'
        | 'tooLarge'
        | 'tooMany'
        | 'cameraFailed'
        | 'storageFull'
        | 'storageBusy'
        | 'storageFailed'
        | 'damaged'
        | 'internal'
      )
    | ('retained' | 'superseded' | 'cloned')
    | null;
  detail: string;
}
