// The one interface of a robot that the page knows: intents in, one snapshot and events out. Whether it is on a cable of this
// computer's own (localRobot.ts) or at a gateway is not known above; what it cannot do is in its snapshot.

import type { Frame, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import type { LeaseAction } from './lease.ts';
import type { HaltReason, Motions, SessionEvents, SessionState, SlotGroup } from './state.ts';

/** Every operation throws or rejects with a LinkError; see linkError.ts for the codes. */
export interface Robot {
  readonly state: SessionState;
  subscribe(listener: Partial<SessionEvents>): () => void;
  /** Rejects when the first attempt fails; a failure that passes by itself is tried again nevertheless. */
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  /** After `heldElsewhere` or `movedAway`: the other tab stops the robot and lets go, then this one connects. */
  takeOver(): Promise<void>;
  /** The page is about to go: unless others can drive, a stop leaves and the link is lost. */
  leave(): void;
  /** Off: a lost link stays lost until `retryNow`. */
  setAutoReconnect(enabled: boolean): void;
  /** Identifies the board again. */
  identify(): Promise<void>;
  /** A person says which board this is. Refused in the link's state where its answers say otherwise. */
  choose(family: Family): Promise<void>;
  /** About who drives, where several can; the outcome is in `state.lease`. */
  lease(action: LeaseAction): void;
  /** Where others can drive, the run under way may go on without this end, for so long at most; null: it may not. */
  letRun(forMs: number | null): void;
  /** Moves of this servo may pass the limits that the gateway holds; null ends it, and so does the end of the link. */
  calibrate(servo: number | null): void;
  /** What is left of moves was judged by other limits and is not sent. A gateway judges by itself. */
  limitsChanged(): void;
  /**
   * Newest wins per servo. Positions in the family's unit; `durationMs` 0 is as fast as the link allows. Refused while a group may run.
   * A longer move leaves in parts (ADR 58).
   */
  move(targets: readonly ServoTarget[], durationMs: number): void;
  /** `times` 0 repeats until stopped. A group that runs already is stopped first (S45, S46). */
  run(slot: number, times: number, options?: RunOptions): Promise<void>;
  /** Ends the running group after its frame in progress. Leaves everything else free to move. */
  stopGroup(): Promise<void>;
  /** STOP: see safety.md section 1. Resolves when the whole sequence has left the wire. */
  halt(why?: HaltReason): Promise<void>;
  /** Allows motion again. Moves nothing. */
  resume(): Promise<void>;
  /** Erases every slot of the board. */
  erase(): Promise<void>;
  /** Millivolts. */
  readBattery(): Promise<number>;
  /** New runs and plays are refused with the battery at or below; null: never. A gateway judges by itself. */
  refuseRunsBelow(alarmMv: number | null): void;
  /** A packet written by hand, as it is. Rejects with what keeps this board from getting it: raw.ts. */
  sendRaw(packet: Uint8Array): Promise<void>;
  /** Reads the positions of these servos; the answer is in `state.reported`. */
  readPositions(servos: readonly number[]): Promise<void>;
  /** Into `state.version`. */
  readVersion(): Promise<void>;
  /** Into `state.offsets`. */
  readOffsets(): Promise<void>;
  /** How fast the board plays the group in `slot`, null for every group, until it is switched off. */
  setSpeed(slot: number | null, percent: number): Promise<void>;
  /** Takes the torque off: what these servos carry drops. Only after a person was warned. */
  release(servos: readonly number[]): Promise<void>;
  /** Stores them one after the other, until one fails; progress is in `state.activity`, the end in `state.lastDownload`. */
  download(groups: readonly SlotGroup[]): Promise<void>;
  /** Behind its frame in progress, with the groups behind it, whichever client began it. */
  cancelDownload(): Promise<void>;
  /** Plays from the page. Resolves at the end or after `stopPlaying`. */
  play(frames: readonly Frame[], options?: PlayOptions): Promise<Played>;
  stopPlaying(): void;
  /** As of now. */
  motions(): Motions;
  /** Something moves or may, as far as can be known, also behind the end of a group. */
  isMoving(): boolean;
}

export interface RunOptions {
  /** Also where the battery is at its alarm and new runs are refused. */
  readonly anyway?: boolean;
}

export interface PlayOptions extends RunOptions {
  /** 0: until stopped. */
  readonly times?: number;
  /** Each pass but the first begins with this frame. */
  readonly loopFrom?: number;
}

/** What came of the deadlines. */
export interface Played {
  /** Frames that began so late that those behind them were put off. */
  readonly lateFrames: number;
  /** The latest of them by so much. */
  readonly latestMs: number;
  /** Frames that had not left when the next one took their place, or that the link refused. */
  readonly skippedFrames: number;
  /** The last frame has ended. */
  readonly isWhole: boolean;
}
