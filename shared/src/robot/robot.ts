// One session per link: what should happen, in what order, and what came back. Puts together the line, the outgoing lanes,
// the replies and a driver for the board that is there. Knows no transport by name and no user interface.

import type { Clock } from '../clock.ts';
import type { MotionBefore } from '../motion/before.ts';
import type { Command, Frame, ServoTarget } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES, UNKNOWN_BOARD, type Family } from '../codec/families.ts';
import { commandIn } from '../codec/parse.ts';
import type { Report } from '../codec/reports.ts';
import type { ByteChannel } from './byteChannel.ts';
import { createDriver, type Driver } from './driver.ts';
import { overChannel } from './channelTransport.ts';
import { encodeOrRefuse } from './exchange.ts';
import { createHalt, STOP_PACKET } from './halt.ts';
import { createIdentification } from './identification.ts';
import { createLanes } from './queue.ts';
import { notDriving, type Lease, type LeaseAction } from './lease.ts';
import { createLink, type LineState } from './link.ts';
import { LinkError } from './linkError.ts';
import type { Played } from './player.ts';
import { createReceiver } from './receiver.ts';
import { createReplies } from './replies.ts';
import { createResync } from './resync.ts';
import type { LinkState, Motions, SessionEvents, SessionState } from './state.ts';
import type { SlotMemory } from './slotMemory.ts';
import { createStopAgain } from './stopAgain.ts';
import { createSessionStore, NOTHING_READ } from './store.ts';
import type { HaltReason, SlotGroup, Transport } from './transport.ts';
import { createWakefulClock } from './wakefulClock.ts';

export interface SessionOptions {
  readonly transport: Transport;
  readonly clock: Clock;
  /** What the board is taken for, by a person or from memory. Without it the board is asked, and waits for `choose`. */
  readonly family?: Family | undefined;
  /** Check `family` by harmless questions before anything moves, at each opening. Otherwise its word is enough. */
  readonly identifies?: boolean | undefined;
  /** Whether somebody looks: then an idle board is asked now and again whether it is still there. Absent: never. */
  readonly isWatched?: (() => boolean) | undefined;
  /** Without it broken slots are forgotten with the session; a shared link has its own. */
  readonly slotMemory?: SlotMemory | undefined;
  readonly withheld?: SessionState['withheld'] | undefined;
}

export interface LocalRobotOptions extends Omit<SessionOptions, 'transport'> {
  readonly channel: ByteChannel;
  /** How the channel was chosen. */
  readonly kind: Transport['kind'];
}

/** Every operation throws or rejects with a LinkError; see linkError.ts for the codes. */
export interface Session {
  readonly state: SessionState;
  subscribe(listener: Partial<SessionEvents>): () => void;
  /** Rejects when the first attempt fails; a failure that passes by itself is tried again nevertheless. */
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  /** After `heldElsewhere` or `movedAway`: the other tab stops the robot and lets go, then this one connects. */
  takeOver(): Promise<void>;
  /** The page is about to go: on a link of its own a stop leaves, and the link is lost. */
  leave(): void;
  /** Off: a lost link stays lost until `retryNow`. */
  setAutoReconnect(enabled: boolean): void;
  /** Asks the board again who it is. */
  identify(): Promise<void>;
  /** A person says which board this is. Refused in the link's state where its answers say otherwise. */
  choose(family: Family): Promise<void>;
  /** On a shared link: about who drives; the outcome is in `state.lease`. */
  lease(action: LeaseAction): void;
  /** On a shared link: the run under way may go on without this end, for so long at most; null: it may not. */
  letGoOn(forMs: number | null): void;
  /** On a shared link: moves of this servo may pass the robot's limits; null ends it, and so does the end of the link. */
  calibrate(servo: number | null): void;
  /** Newest wins per servo. Positions in the family's unit; `durationMs` 0 is as fast as the link allows. */
  move(targets: readonly ServoTarget[], durationMs: number): void;
  /** `times` 0 repeats until stopped. A group that runs already is stopped first (S45, S46). */
  run(slot: number, times: number): Promise<void>;
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
  /** A packet written by hand, as it is. Rejects with what keeps this board from getting it: rawPacket.ts, raw.ts. */
  sendRaw(packet: Uint8Array): Promise<void>;
  /** Asks where these servos stand; the board's word is in `state.reported`. */
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
  /** Behind its frame in progress, with the groups behind it; on a shared link, whoever began it. */
  cancelDownload(): Promise<void>;
  /** Plays from the page. Resolves at the end or after `stopPlaying`. */
  play(
    frames: readonly Frame[],
    options?: {
      /** 0: until stopped. */
      readonly times?: number;
      /** Each pass but the first begins with this frame. */
      readonly loopFrom?: number;
    },
  ): Promise<Played>;
  stopPlaying(): void;
  /** As of now. */
  motions(): Motions;
}

export function createLocalRobot({ channel, kind, ...options }: LocalRobotOptions): Session {
  return createSession({ ...options, transport: overChannel(channel, kind) });
}

export function createSession(options: SessionOptions): Session {
  const { transport, slotMemory, family = UNKNOWN_BOARD } = options;
  const { identifies = false, isWatched = () => false, withheld = [] } = options;
  const clock = createWakefulClock(options.clock, overslept);
  const store = createSessionStore({ family, canShare: transport.commands !== undefined, withheld });
  const replies = createReplies(clock);
  /** The link was opened and not only mended. */
  let isNew = false;
  let openedMs = 0;
  /** Until it is known which board moves so. */
  let before: MotionBefore | null = null;

  const link = createLink({
    transport,
    clock,
    received: (bytes, whole = false) => receiver.push(bytes, whole),
    unread: (bytes) => heardNoise('garbage', bytes),
    changed: lineChanged,
    identified: (board) => identification.told(board),
    battery: (battery) => store.update({ battery }),
    described: (robotOnBoard) => store.update({ robotOnBoard }),
    placed: (motion) => (before = motion),
    leased,
    slotsChanged() {
      if (store.state.link.status === 'ready') driver.groups.linked();
    },
    left: sentElsewhere,
    heard,
    noise: heardNoise,
    playing: (progress) => driver.live.told(progress),
    waiting: (waitingToStart) => store.update({ waitingToStart }),
    moveFailed,
    claimed: () => halt.halt(),
    withholds: (commands) => store.update({ withheld: commands }),
    latched(reason, by = null) {
      if (reason === null) halt.released();
      else if (store.state.latch === null) halt.latchedElsewhere(reason, by);
    },
    halted: (unheld) => halt.sharedHalted(unheld),
    resumed: (by) => store.emit('resumed', by),
  });

  /** This end's packets, too. */
  const tellsWhatLeft = transport.commands !== undefined;
  const lanes = createLanes({
    clock,
    serviceGapMs: UNKNOWN_BOARD.serviceGapMs,
    send: link.send,
    takeMove: () => driver.takeMove(),
    leaving: (packet) => tellsWhatLeft || note(packet, commandIn(packet)),
    sent: (packet) => tellsWhatLeft || take(commandIn(packet)),
    moveFailed,
  });

  let driver: Driver = driverFor(family);
  const halt = createHalt({
    ...{ clock, store, lanes, transport, dropAll: (error) => driver.drop(error) },
    plan() {
      const leaving = lanes.unfinished();
      return driver.core.robot.haltPlan(leaving && commandIn(leaving));
    },
    hold: () => driver.core.robot.hold(),
    unheldSince: (pressedMs) => driver.core.robot.unheldSince(pressedMs),
    servosPerMove: () => driver.core.servosPerMove,
    encoded: (hold) => encodeOrRefuse(hold, driver.core.family),
  });
  const stopAgain = createStopAgain(
    clock,
    () => driver.core.robot.deafUntilMs(),
    () => {
      if (driver.core.robot.moving()) halt.again();
    },
  );
  const resync = createResync(lanes);
  const identification = createIdentification({
    ...{ clock, store, lanes, replies, transport, family, identifies, isWatched },
    isMoving: () => driver.core.robot.moving(),
    readBattery: () => driver.readBattery(),
    drive,
    entered,
  });
  const receiver = createReceiver({
    clock,
    family: identification.heardAs,
    report: heard,
    noise: heardNoise,
  });

  function driverFor(next: Family): Driver {
    return createDriver(next, { clock, store, lanes, replies, slotMemory, shared: transport });
  }

  function moveFailed(error: LinkError): void {
    driver.live.moveFailed();
    store.emit('problem', error);
  }

  /** The board is taken for something else: whatever was believed of it was about another one. */
  function drive(next: Family): void {
    if (next === driver.core.family) return;
    driver.drop(new LinkError('cancelled', 'the board is taken for another one now'));
    driver = driverFor(next);
    store.update({
      ...{ family: next, brokenSlots: [], storedSlots: [], lastDownload: null },
      ...NOTHING_READ,
      // A shared link tells of its own.
      ...(transport.readBattery === undefined ? { battery: { kind: 'unread' } } : {}),
    });
  }

  /** What waited to leave does not any more; a group that the board plays goes on, and so does a download. */
  function overslept(): void {
    const error = new LinkError('overslept', 'this computer or page slept');
    if (driver.live.drop()) store.emit('problem', error);
    if (store.state.activity.kind !== 'downloading') lanes.purge(error);
  }

  /** What was under way here belongs to the turn that is over. */
  function leased(lease: Lease): void {
    const hasLost = store.state.lease?.drives === true && !lease.drives;
    store.update({ lease });
    if (hasLost) driver.drop(notDriving(lease));
  }

  /** Into the log when it begins to leave, so that its answer comes after it. */
  function note(bytes: Uint8Array, command: Command | null): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'out', bytes, command });
  }

  /** Into the estimate when it has left: not before can the board act on it. */
  function take(command: Command | null): void {
    if (command === null) return;
    driver.applied(command);
    if (command.kind === 'stop') stopAgain.stopped();
  }

  /** A link that stores groups says so itself: told late, its frame would pass for one that is being stored now. */
  function sentElsewhere(command: Command): void {
    const bytes = bytesForLog(command, driver.core.family);
    if (bytes !== null) note(bytes, command);
    if (command.kind !== 'download') take(command);
  }

  function heard(report: Report, bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, report });
    lanes.answered(bytes[3] ?? 0);
    replies.deliver(report);
    const mightSwallow = driver.core.robot.maySwallow();
    driver.groups.heard(report);
    driver.readings.heard(report);
    if (report.kind === 'runStopped') halt.confirmed();
    stopAgain.heard();
    const hearsAgain = mightSwallow && !driver.core.robot.maySwallow();
    if (hearsAgain || report.kind === 'runAccepted' || report.kind === 'runStarted') halt.again();
    identification.heard(report, bytes);
  }

  function heardNoise(noise: 'garbage' | 'truncated', bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, noise });
    identification.heardNoise(bytes);
  }

  function lineChanged(line: LineState): void {
    if (line.status !== 'open') {
      if (store.state.lease !== null) store.update({ lease: null });
      identification.ended();
      entered(line);
      return;
    }
    if (line.isReturn) lanes.returned();
    resync.send();
    isNew = !line.isReturn;
    openedMs = clock.now();
    if (line.isReturn) halt.stopAfterReturn();
    identification.begin();
  }

  function entered(next: LinkState): void {
    const previous = store.state.link.status;
    if (next.status === 'ready' && next.status !== previous) becomesReady();
    if (next.status !== 'opening') before = null;
    store.update({ link: next });
    if (next.status === previous) return;
    if (previous === 'stale' && link.isOpen) halt.stopAfterReturn();
    if (previous === 'ready') unlinked(next);
  }

  /** Whoever hears of it finds what is known of its slots and servos. */
  function becomesReady(): void {
    driver.groups.linked();
    if (before !== null) driver.core.robot.placed(before);
    // A shared link says itself what may go on, and a board of the page's own is as new as its link.
    if (isNew && transport.halt === undefined && !transport.isSimulated) driver.core.robot.opened(openedMs);
    isNew = false;
  }

  /** The board may have moved, restarted or been changed for another before it is ready again. */
  function unlinked(next: LinkState): void {
    const packet = lanes.unfinished();
    stopAgain.void();
    if (!link.isOpen) receiver.reset();
    driver.core.robot.forget(packet && commandIn(packet));
    // A shared link has its own way to mend the wire behind it.
    if (packet !== null && !link.isOpen && transport.halt === undefined) {
      resync.cut(packet, driver.core.family.resyncFiller);
      driver.core.robot.cut();
    }
    // Nothing ends it at the return.
    if (next.status === 'closed') driver.core.robot.groupEnded();
    driver.groups.unlinked();
    store.update(NOTHING_READ);
    if (next.status === 'lost' || next.status === 'stale') halt.latchedByLoss();
    else driver.drop(new LinkError('closed', 'the link was closed'));
  }

  return {
    get state() {
      return store.state;
    },
    subscribe: store.subscribe,
    open: link.open,
    async close() {
      await link.close();
      store.update({ latch: null });
    },
    retryNow: link.retryNow,
    takeOver: link.takeOver,
    leave: () => transport.halt === undefined && link.leave(STOP_PACKET),
    setAutoReconnect: link.setAutoReconnect,
    identify: identification.again,
    choose: (chosen) => identification.choose(chosen),
    lease: (action) => transport.lease?.(action),
    letGoOn: (forMs) => transport.letGoOn?.(forMs),
    calibrate: (servo) => transport.calibrate?.(servo),
    move: (targets, durationMs) => driver.live.move(targets, durationMs),
    run: (slot, times) => driver.groups.run(slot, times),
    stopGroup: () => driver.groups.stop(),
    halt: halt.halt,
    resume: halt.resume,
    erase: () => driver.groups.erase(),
    readBattery: () => driver.readBattery(),
    sendRaw: (packet) => driver.sendRaw(packet),
    readPositions: (servos) => driver.readings.readPositions(servos),
    readVersion: () => driver.readings.readVersion(),
    readOffsets: () => driver.readings.readOffsets(),
    setSpeed: (slot, percent) => driver.setSpeed(slot, percent),
    release: (servos) => driver.release(servos),
    download: (groups) => driver.groups.download(groups),
    cancelDownload: () => driver.groups.cancelDownload(),
    play: (frames, playing) => driver.live.play(frames, playing?.times ?? 1, playing?.loopFrom ?? 0),
    stopPlaying: () => driver.live.stopPlaying(),
    motions: () => driver.core.robot.motions(),
  };
}

/** A board that is asked who it is gets questions that only others know. */
function bytesForLog(command: Command, family: Family): Uint8Array | null {
  for (const one of [family, ...Object.values(FAMILIES)]) {
    try {
      return encodeCommand(command, one);
    } catch {
      continue;
    }
  }
  return null;
}
