// What the session believes of the robot: the motion estimate fed with what left the wire, the groups it stored itself,
// and how slow a servo's first move must be. Knows the clock; no link, no queue.

import type { Clock } from '../clock.ts';
import {
  takenOver,
  type Goal,
  headedFor,
  type MotionBefore,
  eitherOf,
  forgotten,
  inherited,
  UNKNOWN_MOTION,
  type KnownBoard,
  type Motion,
} from '../motion/model.ts';
import { afterCut, afterEnd, afterReport } from '../motion/reports.ts';
import { haltPlan, holdBehindStop, unheldSince, type HaltPlan, type Unheld } from '../motion/haltPlan.ts';
import {
  advance,
  afterCommand,
  afterCutPacket,
  afterFiller,
  farthestFrom,
  gentleMs,
  hears,
  passMs,
  positionAt,
  readingOf,
  remainingMs,
  targetOf,
  unknownRestMs,
  withoutServos,
} from '../motion/motion.ts';
import { carriesAll, intervalMs, nextPart, partDueMs, type ServoOrder } from '../motion/parts.ts';
import { lastEndMs, only, stands } from '../motion/tracks.ts';
import type { Command, Frame, MoveCommand, ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { moveBytes, wireMs } from '../codec/packet.ts';
import type { Report } from '../codec/reports.ts';
import type { Motions, ServoMotion } from './state.ts';
import { FIRST_MOVE_MS, HOLD_AGAIN_MS, RANGE_MS } from './timings.ts';
import timings from '../../protocol/timings.json' with { type: 'json' };

export interface RobotEstimate {
  /** A command's last bit left the wire just now. */
  applied(command: Command): void;
  /** The board said something just now. */
  heard(report: Report): void;
  motions(): Motions;
  /** Nothing has moved it, and the board has not said where it stands. */
  isUnknown(servo: number): boolean;
  /** How long a move of these takes at least because a servo of unknown place starts with it or is on its first way still; else 0. */
  firstMs(servos: readonly number[]): number;
  /**
   * The next packet: these orders, and the servos under way that have to go on with it (parts.ts); null where nothing has to leave now.
   * An order of 0 ms is as fast as the soft limit lets it be, from where the servo is when the packet arrives. It counts as sent.
   */
  takePart(orders: readonly ServoOrder[], servosPerMove: number): MoveCommand | null;
  /** When the next part has to begin to leave, without a new order; Infinity where none follows. */
  partDueMs(): number;
  /** What is left of the moves of these servos, or of all, is not sent. */
  dropParts(servos?: readonly number[]): void;
  /** A move of that time would make another servo under way faster: how long it takes at least, else 0. */
  hastenedMs(move: MoveCommand): number;
  groupMayRun(): boolean;
  /** At most, as far as the moves go that are known; a group is another matter. */
  movesForMs(): number;
  /** What a STOP pressed now holds and what not; `leaving` is on the wire and cannot be called back. */
  haltPlan(leaving: Command | null, holdsToFollow?: number): HaltPlan;
  /** What holds the robot, as a move that begins to leave now, a gap behind a stop. */
  hold(): MoveCommand | null;
  /** The same where the one before may not have been heard: the servos have gone on, and are not torn back. Where it was, nothing moves. */
  holdAgain(): MoveCommand | null;
  /** The motion that continues in spite of a STOP pressed then, whose last packet left just now. */
  unheldSince(pressedMs: number, holdsToFollow: number): Unheld | null;
  moving(): boolean;
  /** What is known of the group that may run: with its frames, when it ends. */
  groupRuns(): 'no' | 'known' | 'unknown';
  /** The group that runs is taken to have ended, without a word of the board. */
  groupEnded(): void;
  stored(slot: number, frames: readonly Frame[]): void;
  /** What is in `slot` is no longer what we stored; without a slot, in all of them. */
  unstored(slot?: number): void;
  storedSlots(): readonly number[];
  /** Milliseconds that one pass of the group takes at most, or null when its frames are unknown. */
  groupMs(slot: number): number | null;
  /** Nothing is known any more: the board may have moved or restarted behind our back. `cut` may have arrived or not. */
  forget(cut: Command | null): void;
  /** A packet of ours was cut on the way, and nothing ends it but what is sent next. */
  cut(): void;
  /** The filler that ends the packet that was cut left the wire just now. */
  filled(): void;
  /** The board may take what is sent next for the rest of a packet that was cut. */
  maySwallow(): boolean;
  /** It may not take up what is sent before. */
  deafUntilMs(): number;
  /** The link was opened then: others may have set something in motion before. */
  opened(atMs: number): void;
  /** Servos of a move that left just now go on to there, in parts that others send. */
  headedFor(goals: readonly Goal[]): void;
  /** What others, who saw it move, know of it just now. */
  placed(before: MotionBefore): void;
}

export function createRobotEstimate(family: Family, clock: Clock): RobotEstimate {
  const memory = createGroupMemory();
  const board: KnownBoard = { family, playedFrames: memory.playedFrames };
  let motion = UNKNOWN_MOTION;
  /** What a loss of the link has cut last. */
  let latestCut: Command | null = null;

  const now = (): Motion => (motion = advance(motion, clock.now(), board));

  /** A frame of a known group that is due was begun from what was stored until now. */
  function changeMemory(change: () => void): void {
    now();
    change();
  }

  function isUnknown(servo: number): boolean {
    return targetOf(now(), servo) === null && positionAt(now(), servo, clock.now()) === null;
  }

  function firstMs(servos: readonly number[]): number {
    const gentle = servos.some(isUnknown) ? Infinity : gentleMs(now(), servos, clock.now(), family);
    return Math.min(FIRST_MOVE_MS, gentle);
  }

  function softMs(swift: readonly ServoTarget[], arrivesMs: number): number {
    const motion = now();
    const ways = swift.map(({ servo, position }) => farthestFrom(motion, servo, position, arrivesMs, family));
    const share = Math.max(0, ...ways) / (family.position.max - family.position.min);
    // Boards cut what is no whole tick.
    return Math.ceil((share * RANGE_MS) / family.motion.tickMs) * family.motion.tickMs;
  }

  const hold = (): MoveCommand | null => holdBehindStop(now(), clock.now() - family.serviceGapMs, board);

  /** Those that are to go as fast as they may arrive together. */
  function timed(orders: readonly ServoOrder[]): readonly ServoOrder[] {
    const swift = orders.filter(({ durationMs }) => durationMs === 0);
    if (swift.length === 0) return orders;
    const swiftMs = Math.max(
      intervalMs(orders.length, family),
      softMs(swift, clock.now() + wireMs(moveBytes(orders.length))),
    );
    return orders.map((order) => (order.durationMs === 0 ? { ...order, durationMs: swiftMs } : order));
  }

  function takePart(orders: readonly ServoOrder[], servosPerMove: number): MoveCommand | null {
    const motionNow = now();
    const servos = orders.map(({ servo }) => servo);
    const othersMs = carriesAll(family) ? unknownRestMs(motionNow, servos, clock.now()) : 0;
    const leastMs = Math.max(firstMs(servos), othersMs);
    const part = nextPart(motionNow, timed(orders), clock.now(), { family, servosPerMove, leastMs });
    if (part === null) return null;
    motion = { ...motionNow, courses: part.courses };
    return part.move;
  }

  function dropParts(servos?: readonly number[]): void {
    if (motion.courses.size === 0) return;
    const others =
      servos === undefined ? [] : [...motion.courses].filter(([servo]) => !servos.includes(servo));
    motion = { ...motion, courses: new Map(others) };
  }

  function hastenedMs({ targets, durationMs }: MoveCommand): number {
    if (!carriesAll(family)) return 0;
    const requested = targets.map(({ servo }) => servo);
    const others = withoutServos(now(), requested).tracks;
    const restMs = Math.ceil(
      lastEndMs(
        only(others, (track) => !stands(track, clock.now())),
        clock.now(),
      ) - clock.now(),
    );
    return restMs > durationMs + family.motion.tickMs ? restMs : 0;
  }

  return {
    applied(command) {
      const isHeard = hears(now(), clock.now());
      motion = afterCommand(motion, command, clock.now(), board);
      if (command.kind === 'setSpeed') memory.setSpeed(command.slot, isHeard ? command.percent : null);
      if (command.kind === 'erase') memory.clear();
    },
    heard(report) {
      if (report.kind === 'erased' && motion.answersOwed.includes('erased')) memory.empty();
      motion = afterReport(motion, report, clock.now(), board);
      if (report.kind === 'runFinished') motion = afterEnd(motion, report.slot, clock.now(), board);
      if (report.kind === 'runStopped') motion = afterCut(motion, clock.now(), board);
    },
    motions() {
      const nowMs = clock.now();
      const known = advance(motion, nowMs, board);
      motion = known;
      return (servo) => motionOf(known, servo, nowMs);
    },
    isUnknown,
    firstMs,
    takePart,
    partDueMs: () => partDueMs(now(), clock.now()),
    dropParts,
    hastenedMs,
    groupMayRun: () => now().run !== null,
    movesForMs: () => remainingMs(now(), clock.now()),
    haltPlan(leaving, holdsToFollow) {
      const begun = leaving === null ? now() : afterCommand(now(), leaving, clock.now(), board);
      return haltPlan(begun, clock.now(), board, holdsToFollow);
    },
    hold,
    holdAgain() {
      const again = hold();
      if (again === null) return null;
      const leftMs = remainingMs(now(), clock.now());
      if (leftMs === 0) return { ...again, durationMs: Math.max(HOLD_AGAIN_MS, again.durationMs) };
      // A move under way takes no longer for being held again, and a tick that has begun is never cut.
      const { tickMs } = family.motion;
      return { ...again, durationMs: Math.min(again.durationMs, (1 + Math.ceil(leftMs / tickMs)) * tickMs) };
    },
    unheldSince: (pressedMs, holdsToFollow) =>
      unheldSince(pressedMs, now(), clock.now(), board, holdsToFollow),
    moving() {
      const { run, restlessUntilMs } = now();
      return run !== null || restlessUntilMs > clock.now() || remainingMs(now(), clock.now()) > 0;
    },
    groupRuns() {
      const { run } = now();
      if (run === null) return 'no';
      return run.kind === 'unknown' ? 'unknown' : 'known';
    },
    groupEnded: () => (motion = afterCut(motion, clock.now(), board)),
    stored: (slot, frames) => changeMemory(() => memory.store(slot, frames)),
    unstored: (slot) => changeMemory(() => memory.clear(slot)),
    storedSlots: memory.slots,
    groupMs(slot) {
      const frames = memory.playedFrames(slot);
      return frames && passMs(frames, board);
    },
    forget(cut) {
      const nowMs = clock.now();
      const arrived = cut === null ? now() : afterCommand(now(), cut, nowMs, board);
      latestCut = cut ?? latestCut;
      memory.forgetSpeeds();
      motion = eitherOf(forgotten(motion, nowMs), forgotten(arrived, nowMs));
    },
    cut: () => (motion = afterCutPacket(now(), family)),
    filled() {
      if (latestCut?.kind === 'move') motion = afterFiller(now(), latestCut, clock.now(), family);
    },
    maySwallow: () => motion.maySwallow > 0,
    deafUntilMs: () => motion.deafUntilMs,
    opened: (atMs) => (motion = inherited(now(), atMs)),
    headedFor: (goals) => (motion = headedFor(now(), goals, clock.now())),
    placed: (before) => (motion = takenOver(now(), before, clock.now(), family)),
  };
}

/** The one place where it is said where a servo is: reported, else estimated, else unknown. */
function motionOf(motion: Motion, servo: number, nowMs: number): ServoMotion {
  const target = targetOf(motion, servo);
  const reading = readingOf(motion, servo);
  if (typeof reading?.position !== 'number') return { target, estimated: positionAt(motion, servo, nowMs) };
  const at = { target: reading.position, estimated: reading.position };
  if (reading.isReleased) return { ...at, reported: 'released' };
  return { ...at, reported: target === null ? 'untouched' : 'commanded' };
}

export interface GroupMemory {
  store(slot: number, frames: readonly Frame[]): void;
  /** Without a slot, all of them. */
  clear(slot?: number): void;
  /** The board has erased all of them. */
  empty(): void;
  slots(): readonly number[];
  /** Without a slot, of every group (X3); without a percentage it is unknown whether the board took one. */
  setSpeed(slot: number | null, percent: number | null): void;
  /** The board may have lost its speeds with its power, or not. */
  forgetSpeeds(): void;
  /** With the times the board plays them in; empty where nothing is stored, null where the frames or the speed are unknown. */
  playedFrames(slot: number): readonly Frame[] | null;
}

const AS_STORED = timings.run.asStoredPercent;

/** The groups that were stored from here and how fast the board plays them. */
export function createGroupMemory(): GroupMemory {
  const groups = new Map<number, readonly Frame[]>();
  const percents = new Map<number, number | null>();
  let usualPercent: number | null = AS_STORED;
  /** Slots without frames are known to be empty, but for those that something was stored in since. */
  let isErased = false;
  const unknown = new Set<number>();

  function playedFrames(slot: number): readonly Frame[] | null {
    const frames = groups.get(slot);
    if (frames === undefined && isErased && !unknown.has(slot)) return [];
    const own = percents.get(slot);
    const percent = own === undefined ? usualPercent : own;
    if (frames === undefined || percent === null) return null;
    if (percent === AS_STORED) return frames;
    const scaled = (durationMs: number): number => Math.round((durationMs * AS_STORED) / percent);
    return frames.map(({ durationMs, targets }) => ({ durationMs: scaled(durationMs), targets }));
  }

  return {
    store: (slot, frames) => void groups.set(slot, frames),
    clear(slot) {
      if (slot === undefined) {
        groups.clear();
        isErased = false;
        return;
      }
      groups.delete(slot);
      unknown.add(slot);
    },
    empty() {
      groups.clear();
      unknown.clear();
      isErased = true;
    },
    slots: () => [...groups.keys()].sort((a, b) => a - b),
    setSpeed(slot, percent) {
      if (slot !== null) percents.set(slot, percent);
      else {
        percents.clear();
        usualPercent = percent;
      }
    },
    forgetSpeeds() {
      if (percents.size > 0 || usualPercent !== AS_STORED) usualPercent = null;
      percents.clear();
    },
    playedFrames,
  };
}
