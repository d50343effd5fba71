// What a robot says of itself: one immutable snapshot of the link and the robot, and a stream of traffic for the log. Knows no
// cable and no user interface. Every figure says how true it is: requested, estimated or confirmed.

import type { Command, Frame } from '../codec/commands.ts';
import type { Unheld } from '../motion/haltPlan.ts';
import type { Report, ServoOffset } from '../codec/reports.ts';
import type { Family } from '../codec/families.ts';
import type { Lease } from './lease.ts';
import type { Identity } from './identity.ts';
import type { LinkError } from './linkError.ts';

/** What hardware has not confirmed yet for some cable. */
export type Withheld = 'download' | 'erase';

/** Who requests a stop: a person, or the battery's policy on this page. */
export type HaltReason = 'pressed' | 'battery';

/** Why motion is refused without a stop from here: another screen's, no driver while the robot moved, or a link that was lost. */
export type LatchReason = 'elsewhere' | 'battery' | 'unwatched' | 'reconnected';

/** A group and the slot that shall hold it. */
export interface SlotGroup {
  readonly slot: number;
  readonly frames: readonly Frame[];
  /** Which version was seen in that slot, '' for none: where others store too, it is refused when another one is there by now. */
  readonly replaces?: string;
  /** What others may know of it. */
  readonly name?: string;
  readonly documentId?: string | null;
}

/** What is known of a stored group. */
export interface StoredGroup {
  /** The fingerprint, where a page did it. */
  readonly version: string;
  /** Empty where it has none. */
  readonly name: string;
  /** Which one of the library it is of. */
  readonly documentId: string | null;
  readonly by: string;
  /** Since 1970; null where it was not noted. */
  readonly atMs: number | null;
}

/** What was stored in each slot last; unknown slots are not in it. */
export type SlotVersions = Readonly<Partial<Record<number, StoredGroup>>>;

/** Of several groups together. */
export interface DownloadProgress {
  /** Where they go, in this order. */
  readonly slots: readonly number[];
  readonly groupsStored: number;
  readonly framesStored: number;
  readonly frameCount: number;
  readonly bytesSent: number;
  readonly bytesTotal: number;
  readonly remainingMs: number;
}

export interface PlayProgress {
  readonly frameIndex: number;
  readonly frameCount: number;
}

/** Which document of the gateway's library describes the robot on its board; null for none. */
export interface RobotOnBoard {
  readonly document: string | null;
}

/** What it means for a pack is said elsewhere. */
export type Battery =
  | { readonly kind: 'unread' }
  | { readonly kind: 'read'; readonly batteryMv: number; readonly atMs: number }
  /** Three questions in a row stayed unanswered. */
  | { readonly kind: 'silent'; readonly lastMv: number | null };

export type LinkState =
  | { readonly status: 'closed' }
  | { readonly status: 'opening' }
  /** The line is open, the board is being identified. Nothing moves yet. */
  | { readonly status: 'identifying' }
  | { readonly status: 'ready' }
  /** The line is open, the board does not answer what such a board always answers: it may be off. It is queried again. */
  | { readonly status: 'stale'; readonly sinceMs: number }
  /** `retryAtMs` on the robot's clock; null where automatic reconnecting is switched off. */
  | { readonly status: 'lost'; readonly error: LinkError; readonly retryAtMs: number | null }
  /** Only a person can go on: no access, or it is unknown which board this is. */
  | { readonly status: 'refused'; readonly error: LinkError };

/** Motion is refused while this is not null; only `resume` clears it. */
export interface Latch {
  /**
   * `pressed` here, `elsewhere` on another screen, `battery`: its policy, here or there, `unwatched`: its driver was not heard while
   * it moved, `reconnected`: the link came back and no person has resumed yet.
   */
  readonly reason: HaltReason | LatchReason;
  /** Name of the person who stopped it elsewhere; null where it was here. */
  readonly by: string | null;
  /**
   * `sending`: the stop packets are on their way. `sent`: they left the wire. `confirmed`: the board said so, or that it hears them.
   * `unanswered`: such a board answers, and this one did not.
   */
  readonly stop: 'sending' | 'sent' | 'confirmed' | 'unanswered' | 'failed';
  /** What may go on in spite of it; null: all is held. */
  readonly unheld: Unheld | null;
}

export type Activity =
  | { readonly kind: 'idle' }
  /** `truth` is `requested` until the board acknowledges; an acknowledgement proves reception only (S18). */
  | {
      readonly kind: 'running';
      readonly slot: number;
      readonly times: number;
      readonly sinceMs: number;
      readonly truth: 'requested' | 'acknowledged' | 'unknown';
    }
  | ({ readonly kind: 'playing' } & PlayProgress)
  /** `slot` is being filled now. */
  | ({ readonly kind: 'downloading'; readonly slot: number } & DownloadProgress)
  | { readonly kind: 'erasing' };

/** What the board said of one servo, in its unit, and when, on the robot's clock. */
export interface Reading {
  readonly position: number;
  readonly atMs: number;
}

export interface SessionState {
  readonly link: LinkState;
  /** What the board is taken for; `UNKNOWN_BOARD` before that is known. */
  readonly family: Family;
  /** Others may look on and drive, too, and its work continues without this end. */
  readonly canShare: boolean;
  /** Commands that this link is not to carry, although the board may know them. */
  readonly withheld: readonly Withheld[];
  /** The answers of the board to identification; empty where it was not queried. */
  readonly identity: Identity;
  readonly latch: Latch | null;
  /** Who drives a robot that others can drive, too; null on a link of one's own. */
  readonly lease: Lease | null;
  readonly activity: Activity;
  /** What others began before the link was opened may go on: the board has not said yet that it hears the stops. */
  readonly mayBeRunning: boolean;
  /** Commanded to move, but their positions are unknown: they start one after another, in this order (safety.md). */
  readonly waitingToStart: readonly number[];
  readonly battery: Battery;
  /** Where servos stand by the board's own word, the newest one for each servo number. */
  readonly reported: Readonly<Record<number, Reading>>;
  /** The firmware's, or null before the board has said it. */
  readonly version: number | null;
  readonly offsets: readonly ServoOffset[] | null;
  /** Slots whose download was begun and not finished, here or in an earlier visit: broken on the board (S35). */
  readonly brokenSlots: readonly number[];
  /** Null where no other client can store. */
  readonly slotVersions: SlotVersions | null;
  /** How far the download before this moment came, by whichever client; null where none is known. */
  readonly lastDownload: Pick<DownloadProgress, 'slots' | 'groupsStored'> | null;
  /** What was stored from here, by slot. */
  readonly storedSlots: readonly number[];
  /** Which robot of the gateway's library it is; null on a link of one's own. Another object whenever the gateway says so. */
  readonly robotOnBoard: RobotOnBoard | null;
}

/** The commanded and the current position of a servo, as far as known: every input starts from here. */
export interface ServoMotion {
  /** The last commanded position; at rest the board's report takes its place. null before either. */
  readonly target: number | null;
  /** The best known position: reported while nothing of ours has moved it since, else estimated. null while unknown. */
  readonly estimated: number | null;
  /**
   * Left out unless both are the board's word. `commanded`: of a servo that holds its commanded position, `untouched`: of one that was
   * not commanded yet, `released`: of one without torque, which hands may have turned since.
   */
  readonly reported?: 'commanded' | 'untouched' | 'released';
}

/** Nothing but a command of ours can have moved it from where it is taken to be: its next move need not be slow. */
export const startsKnown = ({ estimated, reported }: ServoMotion): boolean =>
  estimated !== null && reported !== 'released';

/** It holds its commanded position, or is on its way there. */
export const wasCommanded = ({ target, reported }: ServoMotion): boolean =>
  target !== null && (reported ?? 'commanded') === 'commanded';

/** Of each servo, all as of one moment. */
export type Motions = (servo: number) => ServoMotion;

export type Traffic = { readonly atMs: number; readonly bytes: Uint8Array } &
  /** Null where it is no command: filler after a cut packet, or a number that the board ignores, sent by hand. */
  (
    | { readonly direction: 'out'; readonly command: Command | null }
    | { readonly direction: 'in'; readonly report: Report }
    | { readonly direction: 'in'; readonly noise: 'garbage' | 'truncated' }
  );

export interface SessionEvents {
  state(state: SessionState): void;
  traffic(entry: Traffic): void;
  /** A request without an answer (a slider's move, a frame being played) could not be done. */
  problem(error: LinkError): void;
  /** Something runs that would have been judged by the battery, whose voltage is not known. */
  batteryUnknown(nothing: undefined): void;
  /** Another client has resumed motion. */
  resumed(by: string): void;
}
