// STOP on a cable of this computer: latch, drop what is queued, send stop three times, hold the robot where it is estimated to be. How far
// the stop has come is noted by latch.ts; motion waits until a person resumes. And what a board may have missed is sent again: the end of a
// packet that a lost link cut, and one more stop behind flash work, during which a board keeps one packet and drops others (S9, S41, S53).

import timings from '../../protocol/timings.json' with { type: 'json' };
import { sleep, type Clock } from '../clock.ts';
import { encodeCommand } from '../codec/encode.ts';
import { UNKNOWN_BOARD } from '../codec/families.ts';
import { stopsIn } from '../codec/parse.ts';
import { wireMs } from '../codec/packet.ts';
import type { ReportKind } from '../codec/reports.ts';
import type { HaltPlan, Unheld } from '../motion/haltPlan.ts';
import { LinkError } from './linkError.ts';
import type { Queue } from './queue.ts';
import { createMotionLatch } from './latch.ts';
import type { HaltReason } from './state.ts';
import type { SessionStore } from './store.ts';
import { HOLDS_AGAIN, STOP_AGAIN_MS, STOP_EVERY_MS, STOP_REPEATS, STRAY_BYTES } from './timings.ts';
import { COMMAND_NUMBER } from '../codec/commands.ts';

export interface Halt {
  halt(why?: HaltReason): Promise<void>;
  /** The same packets without the latch: a group shall begin where something moves. */
  endMotion(): Promise<void>;
  /** As `endMotion`, where this program can stop nothing any more behind it: resolves when the stops have left that a stray byte can swallow. */
  endBeforeClosing(): Promise<void>;
  /** The stops that end a group behind its frame have left: more follow for a board that took these for the rest of a packet. */
  insistOnEnd(isWanted: () => boolean): Promise<void>;
  resume(): Promise<void>;
  /** The link went: a person must look before anything moves again. */
  latchedByLoss(): void;
  /**
   * The line is open, for the first time or again: what others left unfinished on it is filled with stops, then the robot is stopped.
   * Resolves when these have left; nothing else leaves before. Behind a loss a person must resume.
   */
  opened(isReturn: boolean): Promise<void>;
  /** The board is back after a silence: end what may still run, wait for a person. */
  stopAfterReturn(): void;
  /** It answers for the first time since the line was opened: now it hears for sure. Resolves when these stops have left. */
  stopAtAnswer(): Promise<void>;
  /**
   * The board says that a group runs: behind a stop it is one that it held while its flash worked, which drops stops (S9, S41). Or it
   * answers for the first time since a packet was cut: the stops since then it may have taken for the rest of that. Or it was deaf
   * when they left.
   */
  again(): void;
  confirmed(): void;
  /** The board has said something of that kind. */
  heard(kind: ReportKind): void;
}

/** A STOP that is leaving. */
interface Sequence {
  readonly pressedMs: number;
  stopsToGo: number;
  /** When the next stop may begin to leave. */
  dueMs: number;
  /** The board had answered before the latest stop. */
  wasHeard: boolean;
  left: Promise<Unheld | null>;
}

/** What such a board is asked behind a stop, and what it answers where it hears. */
interface Confirmation {
  readonly question: Uint8Array;
  readonly answer: ReportKind;
}

export interface HaltOptions {
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly queue: Queue;
  /** What a STOP pressed now holds, and what not. */
  plan(holdsToFollow: number): HaltPlan;
  /** The move that holds the robot and begins to leave now; null where there is nothing to hold. */
  hold(isAgain: boolean): HaltPlan['hold'];
  /** As many as one packet holds. */
  servosPerMove(): number;
  /** The motion that continues in spite of a STOP pressed then, whose last packet left just now. */
  unheldSince(pressedMs: number, holdsToFollow: number): Unheld | null;
  encoded(hold: NonNullable<HaltPlan['hold']>): Uint8Array;
  /** So many bytes the board may take for the rest of what others left on the line; 0 on a link that frames its packets. */
  leftOverBytes(): number;
  /** Null where such a board may stay silent, or where no question may leave now. */
  confirmation(): Confirmation | null;
  dropAll(error: LinkError): void;
}

export function createHalt(options: HaltOptions): Halt {
  const { clock, store, queue, dropAll } = options;

  let sequence: Sequence | null = null;
  /** What the board has to answer to the question behind the latest STOP, and whether it has. */
  let asked: ReportKind | null = null;
  let isHeard = false;
  /** Counted, so that a stop that came later ends the insisting of one before. */
  let insistences = 0;
  const latch = createMotionLatch({
    ...{ clock, store, unheldSince: (pressedMs) => options.unheldSince(pressedMs, 0) },
    drop: () => dropAll(new LinkError('latched', 'stopped')),
  });

  /**
   * Others may have pressed STOP, too: it is built when it leaves, behind their stops. Where the link carries no packet that holds
   * all servos, the others follow in the next.
   */
  async function sendHold(holdNow = (): HaltPlan['hold'] => options.hold(false)): Promise<void> {
    const held = new Set<number>();
    let wanted = 0;
    const part = (): HaltPlan['hold'] => {
      const hold = holdNow();
      const targets = hold?.targets.filter(({ servo }) => !held.has(servo)) ?? [];
      return hold && targets.length > 0
        ? { ...hold, targets: targets.slice(0, options.servosPerMove()) }
        : null;
    };
    const packet = (): Uint8Array | null => {
      if (wanted === 0) wanted = holdNow()?.targets.length ?? 0;
      const hold = part();
      for (const { servo } of hold?.targets ?? []) held.add(servo);
      return hold && options.encoded(hold);
    };
    do {
      if (part() === null) return;
      await queue.stop(packet);
    } while (held.size < wanted);
  }

  /**
   * A stop never ends the move in progress (S50), so the first hold follows the first stop at once; the last one catches a
   * frame that began because that stop fell into a full mailbox (S52).
   */
  async function sendSequence(mine: Sequence): Promise<Unheld | null> {
    asked = null;
    isHeard = false;
    try {
      for (let isFirst = true; mine.stopsToGo > 0; isFirst = false) {
        if (mine.dueMs > clock.now()) await sleep(clock, mine.dueMs - clock.now());
        mine.stopsToGo -= 1;
        mine.wasHeard = isHeard;
        mine.dueMs = (await sendStop(clock, queue.stop)) + STOP_EVERY_MS;
        if (isFirst || mine.stopsToGo === 0) await sendHold();
        // An answer before the last stop proves that this one is heard.
        if (mine.stopsToGo === 1) await ask();
      }
    } finally {
      sequence = null;
    }
    if (mine.wasHeard) latch.change({ stop: 'confirmed' });
    insist(mine.pressedMs, options.leftOverBytes()).catch(ignore);
    return options.unheldSince(mine.pressedMs, mine.wasHeard ? 0 : holdsToFollow());
  }

  /** While the board has not confirmed, the hold leaves so often more. */
  const holdsToFollow = (): number => (options.leftOverBytes() > 0 ? HOLDS_AGAIN : 0);

  async function ask(): Promise<void> {
    const confirmation = options.confirmation();
    if (confirmation === null) return;
    await queue.stop(confirmation.question);
    asked = confirmation.answer;
  }

  /**
   * A stray byte before STOP makes the board take all of it for the rest of a packet (S3, S4). So stops go on behind it until the board has
   * confirmed them, or cannot miss them any more, with the hold again where the stray bytes are over; then seldom, until a person resumes.
   */
  async function insist(pressedMs: number, bytes: number): Promise<void> {
    insistences += 1;
    const mine = insistences;
    const isWanted = (): boolean => mine === insistences && sequence === null && isUnconfirmed();
    await sendRows(bytes, () => isWanted() && !isHeard, true);
    if (isWanted()) await judge(pressedMs, bytes, isWanted);
    while (isWanted()) {
      await sleep(clock, STOP_AGAIN_MS);
      if (!isWanted()) return;
      if (isHeard) again();
      else if (store.state.link.status !== 'identifying') await remind(isWanted);
    }
  }

  /** As many stops as a stray byte can make the board miss; the hold behind the first and the last row. */
  async function sendRows(bytes: number, isWanted: () => boolean, holds: boolean): Promise<void> {
    for (let sent = 0; sent < bytes && isWanted(); sent += STRAY_BYTES) {
      const stops = stopPackets(Math.min(STRAY_BYTES, bytes - sent));
      await queue.stop(() => (isWanted() ? stops : null));
      if (holds && (sent === 0 || sent + STRAY_BYTES >= bytes))
        await sendHold(() => (isWanted() ? options.hold(true) : null));
    }
  }

  const isUnconfirmed = (): boolean => {
    const { latch: current } = store.state;
    return current !== null && current.stop !== 'confirmed';
  };

  /** What is to be said now that all these stops have left. */
  async function judge(pressedMs: number, bytes: number, isWanted: () => boolean): Promise<void> {
    if (isHeard) {
      await queue.stop(() => (isWanted() ? STOP_PACKET : null));
      await sendHold(() => (isWanted() ? options.hold(true) : null));
      if (isWanted()) latch.change({ stop: 'confirmed', unheld: options.unheldSince(pressedMs, 0) });
    } else if (asked !== null) {
      latch.change({ stop: 'unanswered', unheld: { servos: null, forMs: Infinity } });
    } else if (bytes > 0) {
      latch.change({ unheld: options.unheldSince(pressedMs, 0) });
    }
  }

  async function remind(isWanted: () => boolean): Promise<void> {
    await queue.stop(() => (isWanted() ? STOP_PACKET : null));
    if (isWanted()) await ask();
  }

  /** Those that nobody pressed; a STOP that is pressed meanwhile sends its own in place of these. */
  async function stopQuietly(leftOverBytes = 0): Promise<Unheld | null> {
    if (leftOverBytes > 0) await queue.stop(stopPackets(leftOverBytes));
    await repeatStop(clock, queue.stop, () => sequence === null);
    return sequence?.left ?? options.unheldSince(latch.pressedMs, 0);
  }

  /** Its failure is the latch's `failed`; no caller waits for it. */
  function stopForPerson(stops: Promise<Unheld | null>): void {
    latch.press();
    const before = insistences;
    async function stopAndRemind(): Promise<void> {
      await latch.follow(stops);
      // A STOP that was pressed meanwhile insists by itself.
      if (before === insistences) await insist(latch.pressedMs, 0);
    }
    stopAndRemind().catch(ignore);
  }

  const stopsFollow = (): boolean => sequence !== null && sequence.stopsToGo > 0;

  function again(): void {
    const { latch: current } = store.state;
    if (current === null || stopsFollow()) return;
    // Also a confirmed one.
    store.update({ latch: { ...current, stop: 'sending' } });
    void latch.settled.then(() => latch.follow(sendOrJoin())).catch(ignore);
  }

  /** Pressed again it joins the one under way: each press is followed by a stop, but presses never put off the hold. */
  function sendOrJoin(): Promise<Unheld | null> {
    if (sequence !== null) {
      if (sequence.stopsToGo === 0) Object.assign(sequence, { stopsToGo: 1, dueMs: clock.now() });
      return sequence.left;
    }
    const mine: Sequence = {
      ...{ pressedMs: latch.pressedMs, stopsToGo: 1 + STOP_REPEATS, dueMs: clock.now() },
      wasHeard: false,
      left: Promise.resolve(null),
    };
    sequence = mine;
    mine.left = sendSequence(mine);
    return mine.left;
  }

  return {
    latchedByLoss: () =>
      latch.set({ reason: 'reconnected', by: null, stop: 'failed', unheld: options.plan(0).unheld }),
    async halt(why = 'pressed') {
      const { unheld } = options.plan(holdsToFollow());
      latch.set({ reason: why, by: null, stop: 'sending', unheld });
      latch.press();
      await latch.follow(sendOrJoin());
    },
    async endMotion() {
      dropAll(new LinkError('cancelled', 'the robot was asked for something else'));
      await sendOrJoin();
    },
    async endBeforeClosing() {
      dropAll(new LinkError('closed', 'the link was closed'));
      await sendOrJoin();
      // A STOP before it goes on no longer: these take its place.
      const mine = (insistences += 1);
      await sendRows(options.leftOverBytes(), () => mine === insistences && !isHeard, true);
    },
    async insistOnEnd(isWanted) {
      const mine = insistences;
      const isStill = (): boolean =>
        isWanted() && mine === insistences && sequence === null && store.state.latch === null;
      await sendRows(options.leftOverBytes(), isStill, false);
    },
    resume: () => latch.release(),
    async opened(isReturn) {
      const stops = stopQuietly(options.leftOverBytes());
      if (isReturn) stopForPerson(stops);
      await stops;
    },
    stopAfterReturn: () => stopForPerson(stopQuietly()),
    async stopAtAnswer() {
      await stopQuietly();
    },
    again,
    confirmed: () => latch.change({ stop: 'confirmed' }),
    heard(kind) {
      if (kind === asked) isHeard = true;
    },
  };
}

const ignore = (): undefined => undefined;

/** Whole ones, back to back: as many as fit. */
const stopPackets = (bytes: number): Uint8Array =>
  Uint8Array.from(
    { length: bytes - (bytes % STOP_PACKET.length) },
    (_, index) => STOP_PACKET[index % STOP_PACKET.length] ?? 0,
  );

/** The same on every board, so also on one that is not identified yet. */
export const STOP_PACKET = encodeCommand({ kind: 'stop' }, UNKNOWN_BOARD);

/** Resolves when that packet has left the wire, ahead of all else that waits. */
type SendFirst = (packet: Uint8Array) => Promise<void>;

/** Resolves, when it has left, with the time at which it began to. */
async function sendStop(clock: Clock, send: SendFirst): Promise<number> {
  await send(STOP_PACKET);
  return clock.now() - wireMs(STOP_PACKET.length);
}

/**
 * Sends a stop now, and repeats of it: each begins to leave so long after the one before, or later where the wire is taken. Two that
 * are closer may both fall into the time in which a board hears none (S54). No more of them leave once `isWanted` says no.
 */
export async function repeatStop(
  clock: Clock,
  send: SendFirst,
  isWanted = (): boolean => true,
): Promise<void> {
  for (let repeat = 0; repeat <= STOP_REPEATS && isWanted(); repeat += 1) {
    const begunMs = await sendStop(clock, send);
    if (repeat < STOP_REPEATS) await sleep(clock, Math.max(0, begunMs + STOP_EVERY_MS - clock.now()));
  }
}

interface Resync {
  /** The link went while this packet was on its way to a board that bears this filler, or none. */
  cut(packet: Uint8Array, filler: number | null): void;
  /** The link is ready: the filler goes first, whatever is sent afterwards. */
  send(): void;
}

const COMMAND_AT = 3;

/**
 * A packet that was cut by a lost link leaves the board waiting for the rest of it, for ever: it would swallow the stop that comes after the
 * return (S2). The filler ends such a packet with the least effect; `filled` hears that it has left.
 */
export function createResync(queue: Queue, filled: () => void): Resync {
  let pending: Uint8Array | null = null;

  async function fill(packet: Uint8Array): Promise<void> {
    await queue.stop(packet);
    pending = null;
    filled();
  }

  return {
    cut(packet, filler) {
      if (filler !== null) pending ??= fillerFor(packet, filler);
    },
    send() {
      // Where it fails the link is lost again, and it is sent at the next return.
      if (pending !== null) fill(pending).catch(() => undefined);
    },
  };
}

/**
 * It is unknown how much of the packet arrived, so the bytes must be harmless at every place of it. A first 00 ends the wait
 * for LEN at once (S1) and makes a move whose count is missing an empty one, where the filler would have the board read
 * what earlier packets left behind (S13); but it names slot 0, which a run and a download must not get. What arrived of a
 * move before the cut takes effect: no byte can prevent that.
 */
function fillerFor(packet: Uint8Array, filler: number): Uint8Array {
  const command = packet[COMMAND_AT];
  if (command === COMMAND_NUMBER.run || command === COMMAND_NUMBER.download)
    return new Uint8Array(timings.line.fillerBytes).fill(filler);
  // Each stop of a row is a packet of its own.
  const bytes = stopsIn(packet) > 0 ? STOP_PACKET.length : packet.length;
  return Uint8Array.of(0, ...new Uint8Array(bytes).fill(filler));
}

interface StopAgain {
  /** A stop has left. */
  stopped(): void;
  /** The board has said something: it may hear from now on. */
  heard(): void;
  /** The line is down, or the board is another one. */
  void(): void;
}

/** `deafUntilMs`: until then the board may miss a stop. `stop` sends it once more. */
export function createStopAgain(clock: Clock, deafUntilMs: () => number, stop: () => void): StopAgain {
  let cancelTimer: (() => void) | null = null;

  function clear(): void {
    cancelTimer?.();
    cancelTimer = null;
  }

  function plan(): void {
    clear();
    cancelTimer = clock.after(Math.max(0, deafUntilMs() - clock.now()), () => {
      cancelTimer = null;
      stop();
    });
  }

  return {
    stopped() {
      if (clock.now() < deafUntilMs()) plan();
      else clear();
    },
    heard() {
      if (cancelTimer !== null) plan();
    },
    void: clear,
  };
}
