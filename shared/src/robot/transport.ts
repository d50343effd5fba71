// The one interface between a session and a way to a board: this computer's serial port, the gateway, or the simulator in
// the page. A transport carries whole packets out and raw bytes in; it knows no command, keeps no queue and retries nothing.

import type { Unheld } from '../motion/haltPlan.ts';
import type { MotionBefore } from '../motion/before.ts';
import type { Command, Frame, ServoTarget } from '../codec/commands.ts';
import type { BoardId } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import type { ChannelEvents, OpenOptions } from './byteChannel.ts';
import type { Battery } from './battery.ts';
import type { SharedBoard } from './identity.ts';
import type { Lease, LeaseAction } from './lease.ts';
import type { LinkError } from './linkError.ts';
import type { Played } from './player.ts';

/** Why a shared link (gateway) refuses motion: another screen, no driver while it moved, or a port that was lost. */
export type SharedLatchReason = 'elsewhere' | 'battery' | 'unwatched' | 'reconnected';

/** Who asks for a stop: a person's hand, or the battery's policy on this page. */
export type HaltReason = 'pressed' | 'battery';

/** What hardware has not confirmed yet for some cable. */
export type Withheld = 'download' | 'erase';

export interface TransportEvents extends Partial<Pick<ChannelEvents, 'claimed' | 'unread'>> {
  /** Bytes from the board, in order, in whatever pieces they came; `whole` where they are whole packets for sure. */
  received(bytes: Uint8Array, whole?: boolean): void;
  /** The link ended by itself. Comes at most once per `open`, never after `close`. */
  lost(error: LinkError): void;
  /** Only a shared link (gateway): what refuses motion for everyone, and who stopped it; null once somebody has resumed. */
  latched?(reason: SharedLatchReason | null, by?: string | null): void;
  /** Only a shared link: the stop of anybody has left the wire; what may go on in spite of it, null where all is held. */
  halted?(unheld: Unheld | null): void;
  /** Only a shared link: whoever else allowed motion again. */
  resumed?(by: string): void;
  /** Only a shared link, which asks the board itself. Told before it is open, and on each change. */
  identified?(board: SharedBoard): void;
  /** Only a shared link, which asks for the battery itself. Told before it is open, and whenever the board has said more. */
  battery?(battery: Battery): void;
  /** Only a shared link: which robot stands on the board. Told once it is open, and whenever any robot has changed there. */
  described?(robot: RobotOnBoard): void;
  /** Only a shared link: this has left the wire, whoever asked for it. */
  left?(command: Command): void;
  /** Only a shared link, which reads what the board says: this, in that packet. */
  heard?(report: Report, packet: Uint8Array): void;
  /** Only a shared link: bytes that belong to no packet. */
  noise?(reason: 'garbage' | 'truncated', bytes: Uint8Array): void;
  /** Only a shared link: what moves before this end came have made of the robot. Told once it is open. */
  placed?(motion: MotionBefore): void;
  /** Only a shared link: what the cable behind it is not to carry. Told once it is open, and on each change. */
  withholds?(commands: readonly Withheld[]): void;
  /** Only a shared link: who drives. Told once it is open, and on each change. */
  leased?(lease: Lease): void;
  /** Only a shared link: something of its `slots` is another now. */
  slotsChanged?(): void;
  /** Only a shared link: how far what it plays is, whoever asked for it; null: nothing any more. */
  playing?(progress: PlayProgress | null): void;
  /** Only a shared link: who waits to start. */
  waiting?(servos: readonly number[]): void;
  /** Only a shared link: something of its `moves` did not leave. */
  moveFailed?(error: LinkError): void;
}

/** A group and the slot that shall hold it. */
export interface SlotGroup {
  readonly slot: number;
  readonly frames: readonly Frame[];
  /** Which version was seen in that slot, '' for none: where another one is there by now, a shared link refuses. */
  readonly replaces?: string;
  /** What a shared link may tell others of it. */
  readonly name?: string;
  readonly documentId?: string | null;
}

/** What a shared link knows of a group that somebody stored. */
export interface StoredGroup {
  /** The fingerprint, where a page did it. */
  readonly version: string;
  /** Empty where it has none. */
  readonly name: string;
  /** Which one of the library it is of. */
  readonly documentId: string | null;
  readonly by: string;
  /** Since 1970; null where nobody noted it. */
  readonly atMs: number | null;
}

/** What was stored in each slot last; a slot of which nobody knows is not in it. */
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

export interface SharedDownload extends DownloadProgress {
  readonly isOver: boolean;
}

/** How a shared link stores groups: by itself, so that it goes on when this end is gone. Known once the link is open. */
export interface SharedSlots {
  /** Slots that hold half a group. */
  readonly broken: readonly number[];
  readonly versions: SlotVersions;
  /** The latest download, whoever began it; null where there was none. */
  readonly download: SharedDownload | null;
  /** In their order; resolves when the board has all of them; rejects with what ended it. */
  store(groups: readonly SlotGroup[]): Promise<void>;
  /** Calls off the one under way. */
  cancel(): Promise<void>;
}

/**
 * What came of a command: the board has taken it, which proves reception only (S18); it should have said so and has not; such a board
 * never says.
 */
export type Outcome = 'acknowledged' | 'silent' | 'sent';

/** What a shared link has the board do by itself: in order, each once. All reject with a LinkError. */
export interface SharedCommands {
  /** What moves ends first. */
  run(slot: number, times: number): Promise<Outcome>;
  stopGroup(): Promise<Outcome>;
  erase(): Promise<Outcome>;
  setSpeed(slot: number | null, percent: number): Promise<Outcome>;
  release(servos: readonly number[]): Promise<Outcome>;
  /** Resolves when the board has said it, behind `received`. */
  read(what: 'positions' | 'version' | 'offsets', servos?: readonly number[]): Promise<unknown>;
}

/** How a shared link moves servos: it merges, keeps the board's pace and lets servos of unknown place start gently. */
export interface SharedMoves {
  /** Newest wins per servo; `left` tells what did. `durationMs` 0: as fast as the link allows. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** With a value that was not handed over yet. */
  servos(): readonly number[];
  /** What was not handed over is not any more, and nothing is told of the rest. */
  clear(): void;
}

export interface PlayProgress {
  readonly frameIndex: number;
  readonly frameCount: number;
}

/** How a shared link plays frames, by its own clock. */
export interface SharedPlayer {
  /** Resolves when it has ended, however. `times` 0: until stopped; each pass but the first begins with frame `loopFrom`. */
  play(frames: readonly Frame[], times: number, loopFrom: number): Promise<Played>;
  /** What was begun from here ends with its frame in progress. */
  stop(): void;
}

/** Which document of a shared link's library describes the robot on its board; null for none. */
export interface RobotOnBoard {
  readonly document: string | null;
}

export interface Transport {
  readonly kind: 'webSerial' | 'webHid' | 'webBluetooth' | 'gateway' | 'simulated';
  /** Names the device for people, e.g. `/dev/ttyUSB0`. */
  readonly label: string;
  /** True where no real board is behind it; known once it is open. */
  readonly isSimulated: boolean;
  /** Only a shared link: says for everybody which board this is; `unknown` has it asked again. `identified` tells what comes of it. */
  setBoard?(board: BoardId): Promise<void>;
  /** Only a shared link: asks for the battery now, for everybody. Resolves with millivolts, behind `battery`. */
  readBattery?(): Promise<number>;
  /** Only a shared link. */
  readonly slots?: SharedSlots;
  readonly moves?: SharedMoves;
  readonly player?: SharedPlayer;
  readonly commands?: SharedCommands;
  /** Only a shared link: about who drives; `leased` follows. */
  lease?(action: LeaseAction): void;
  /** Only a shared link: the run under way may go on without this end, for so long at most; null: it may not. */
  letGoOn?(forMs: number | null): void;
  /** Only a shared link: this end looks for that servo's limits and may pass the present ones; null: no longer. */
  calibrate?(servo: number | null): void;
  /** In bytes. */
  readonly longestPacket: number;
  /** Rejects with a LinkError. May be called again after `lost` or `close`. */
  open(events: TransportEvents, options?: OpenOptions): Promise<void>;
  /** Resolves when the packet's last bit has left the wire. One packet at a time: the caller waits for it. */
  send(packet: Uint8Array): Promise<void>;
  /**
   * A shared link's own stop lane: purge, stop three times, hold the robot, latch. Where it is absent the session does that
   * itself with `send`. What may go on in spite of it `halted` tells first.
   */
  halt?(why: HaltReason): Promise<void>;
  resume?(): Promise<void>;
  /** Calls `notify` when a lost device may be back, sooner than the next attempt. Returns a function that ends it. */
  whenAvailable?(notify: () => void): () => void;
  /** Never rejects; closing twice is harmless. `lastPacket`: as a ByteChannel has it. */
  close(lastPacket?: Uint8Array): Promise<void>;
}
