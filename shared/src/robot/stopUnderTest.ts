// A session on a simulated board, driven through a history and then stopped: what STOP said, what the robot did, and what of that
// the holds caused. Knows the page's verbs and the board's pulses; no estimate. The histories are historiesUnderTest.ts.

import type { Unheld } from '../motion/haltPlan.ts';
import type { Frame } from '../codec/commands.ts';
import { family as familyOf } from '../codec/families.ts';
import { fromHex } from '../codec/packet.ts';
import type { Fault } from '../simulator/faults.ts';
import {
  createFlashChip,
  type FlashChip,
  createGroupStore,
  openLayout,
  encodeFrame,
} from '../simulator/groupStore.ts';
import { LEARM_LAYOUT } from '../simulator/learm/engine.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { createRig, type HeardCommand, type Rig } from './rig.ts';
import { createThrowWatch, situationsOf, type ThrowWatch } from './throwsUnderTest.ts';
import {
  CUT_SLOT,
  FOREIGN_SLOT,
  KNOWN_SLOT,
  SERVOS,
  type Situation,
  type StopHistory,
  type StopStep,
} from './historiesUnderTest.ts';

/** What STOP said, and what the robot did until it said something else; behind flash work a stop is sent once more. */
export interface StopWord {
  readonly unheld: Unheld | null;
  /** Of each servo, when its pulse changed last meanwhile, counted from the press; 0 where it did not. */
  readonly movedForMs: readonly number[];
  /** From the press to the last byte that this speaks of. */
  readonly sentForMs: number;
}

export interface StopOutcome {
  /** What it said at last. */
  readonly unheld: Unheld | null;
  /** All that it said once its packets had left, oldest first. */
  readonly words: readonly StopWord[];
  /** Of each servo, the farthest that a hold took it back against its direction of travel. */
  readonly backBy: readonly number[];
  /** The longest way of a servo within one tick under a hold, where it did not go that fast before. */
  readonly longestStep: number;
  /** Of each servo, the farthest that a STOP of the history or the last one moved it off its way. */
  readonly thrownBy: readonly number[];
  /** What the last STOP met. */
  readonly met: readonly Situation[];
}

const NO_FRAME: Frame = { durationMs: 0, targets: [] };
const ignore = (): undefined => undefined;

const SAMPLE_MS = 5;
/** By then the last hold of a STOP that nothing confirms has ended, also with many servos; then the robot is looked at more seldom. */
const CLOSELY_FOR_MS = 1_300;
export const SELDOM_MS = 250;
/** The longest flash work is over by then, and what waited for it has begun. */
const DEAF_FOR_MS = 4_000;
/** No move is longer. */
const REST_MS = 36_000;
/** A frame of the open firmware's takes as much room as that needs (S38). */
const SERVOS_PLAYED = 8;
/** Flash work takes as long as it can. */
export const SLOW_FLASH: readonly Fault[] = [{ name: 'slowErase', sectorMs: 400 }];
const STORED_WITHIN_MS = 12_000;

/** A session that fails says so in its own tests; here it only matters what the robot does afterwards. */
export function take(rig: Rig, step: StopStep, throws: ThrowWatch): Promise<void> {
  const { session, channel, clock } = rig;
  switch (step.kind) {
    case 'wait':
      return watchedFor(rig, step.ms, throws);
    case 'move':
      try {
        session.move(step.targets, step.durationMs);
      } catch {
        // Latched, or the link is away.
      }
      return Promise.resolve();
    case 'run':
      session.run(step.slot, step.times).catch(ignore);
      return Promise.resolve();
    case 'endGroup':
      session.stopGroup().catch(ignore);
      return Promise.resolve();
    case 'erase':
      session.erase().catch(ignore);
      return Promise.resolve();
    case 'halt':
      throws.pressed();
      session.halt().catch(ignore);
      return Promise.resolve();
    case 'resume':
      throws.resumed();
      session.resume().catch(ignore);
      return Promise.resolve();
    case 'read':
      session.readPositions(SERVOS).catch(ignore);
      return Promise.resolve();
    case 'release':
      session.release(step.servos).catch(ignore);
      return Promise.resolve();
    case 'speed':
      session.setSpeed(step.slot, step.percent).catch(ignore);
      return Promise.resolve();
    case 'download':
      session.download([{ slot: step.slot, frames: step.frames }]).catch(ignore);
      return Promise.resolve();
    case 'cancel':
      session.cancelDownload().catch(ignore);
      return Promise.resolve();
    case 'loss':
      channel.unplug();
      clock.after(100, channel.plugIn);
      return watchedFor(rig, step.awayMs, throws);
    case 'noise':
      throws.disturbed();
      channel.board.receive(fromHex(step.bytes));
      return Promise.resolve();
    case 'restart':
      channel.board.reboot();
      return Promise.resolve();
  }
}

async function watchedFor({ clock }: Rig, ms: number, throws: ThrowWatch): Promise<void> {
  const untilMs = clock.now() + ms;
  while (clock.now() < untilMs) {
    await clock.advance(Math.min(untilMs - clock.now(), throws.everyMs()));
    throws.look();
  }
}

/** What another program left in flash: a group, and one whose download was cut behind its first frame (S35). */
export function foreignFlash(profile: ProfileName, frames: readonly Frame[]): FlashChip {
  const chip = createFlashChip();
  if (!familyOf(profile).commands.includes('download')) return chip;
  const layout = profile.startsWith('learm') ? LEARM_LAYOUT : openLayout(SERVOS_PLAYED);
  const store = createGroupStore(chip, 0, layout);
  const [first = NO_FRAME] = frames;
  store.preload(
    new Map([
      [FOREIGN_SLOT, frames],
      [CUT_SLOT, [...frames, ...frames]],
    ]),
  );
  const place = { slot: CUT_SLOT, frameIndex: 0, frameCount: frames.length + 1 };
  for (const _ of store.saveFrame(place, () => Uint8Array.from(encodeFrame(first)))) continue;
  return chip;
}

/** On a board that has been on for a while, two servos at known places, a group stored. */
export async function prepared(profile: ProfileName, history: StopHistory): Promise<Rig> {
  const family = familyOf(profile);
  const rig = await createRig({
    ...{ profile, family, flash: foreignFlash(profile, history.unknown) },
    ...{ onForMs: history.onForMs, hasPad: history.hasPad },
    faults: history.isSlow ? SLOW_FLASH : [],
  });
  const { session, clock } = rig;
  const { centre } = family;
  session.move(
    SERVOS.slice(0, 2).map((servo) => ({ servo, position: centre })),
    0,
  );
  await clock.advance(2_500);
  if (!family.commands.includes('download')) return rig;
  if (history.wasErased) session.erase().catch(ignore);
  if (history.wasErased) await idle(rig);
  session.download([{ slot: KNOWN_SLOT, frames: history.known }]).catch(ignore);
  await idle(rig);
  return rig;
}

async function idle({ session, clock }: Rig): Promise<void> {
  for (let waitedMs = 0; waitedMs < STORED_WITHIN_MS; waitedMs += 50) {
    await clock.advance(50);
    if (session.state.activity.kind === 'idle') return;
  }
}

export async function stopped(profile: ProfileName, history: StopHistory): Promise<StopOutcome> {
  const rig = await prepared(profile, history);
  const { clock, session, channel } = rig;
  const { board } = channel;
  const throws = createThrowWatch(board, clock);
  session.subscribe({
    traffic(entry) {
      if (entry.direction === 'out' && entry.command !== null) throws.leaves(entry.command);
    },
  });
  const { length: heardBefore } = rig.heard;
  for (const step of history.steps) await take(rig, step, throws);
  const met = situationsOf(
    board,
    history,
    rig.heard.slice(heardBefore).map(({ command }) => command),
  );
  const look = (): readonly number[] => SERVOS.map((servo) => board.pulse(servo));

  const pressedMs = clock.now();
  // Where the link is away, the session stops the board as soon as it is back.
  throws.pressed();
  const settled = session.halt().catch(ignore);
  const holds = watchHolds(rig);
  const words = noteWords(rig, pressedMs);
  let last = look();
  const isOver = (): boolean =>
    clock.now() - pressedMs > DEAF_FOR_MS &&
    board.runningSlot() === null &&
    SERVOS.every((servo) => board.pulse(servo) === board.target(servo));
  while (clock.now() - pressedMs < REST_MS && !isOver()) {
    const isClose = clock.now() - pressedMs < CLOSELY_FOR_MS;
    await clock.advance(isClose ? SAMPLE_MS : SELDOM_MS);
    const pulses = look();
    words.look(pulses.map((pulse, index) => pulse !== last[index]));
    throws.look();
    if (isClose) holds.look();
    last = pulses;
  }
  await settled;
  board.powerOff();
  return {
    ...{ unheld: session.state.latch?.unheld ?? null, words: words.all() },
    ...{ backBy: holds.backBy, longestStep: holds.longestStep(), thrownBy: throws.thrownBy(), met },
  };
}

/** What moves while a stop leaves is measured by what is said behind it. */
function noteWords({ heard, session, clock }: Rig, pressedMs: number) {
  const none = SERVOS.map(() => 0);
  const words: (Omit<StopWord, 'sentForMs'> & { readonly saidForMs: number })[] = [];
  let whileSending = none;

  function sentForMs(saidForMs: number): number {
    const isOfStop = ({ command: { kind }, atMs }: HeardCommand): boolean =>
      (kind === 'stop' || kind === 'move') && atMs <= pressedMs + saidForMs;
    return Math.max(0, (heard.findLast(isOfStop)?.atMs ?? pressedMs) - pressedMs);
  }

  function note(movedForMs: readonly number[]): void {
    const unheld = session.state.latch?.unheld ?? null;
    const word = words.at(-1);
    if (word?.unheld !== unheld) words.push({ unheld, movedForMs, saidForMs: clock.now() - pressedMs });
    else
      words.splice(-1, 1, {
        ...word,
        movedForMs: word.movedForMs.map((forMs, index) => Math.max(forMs, movedForMs[index] ?? 0)),
      });
    whileSending = none;
  }

  return {
    look(hasMoved: readonly boolean[]): void {
      const atMs = clock.now() - pressedMs;
      const moved = whileSending.map((forMs, index) => (hasMoved[index] === true ? atMs : forMs));
      if (session.state.latch?.stop === 'sending') whileSending = moved;
      else note(moved);
    },
    all(): readonly StopWord[] {
      if (whileSending !== none) note(whileSending);
      return words.map(({ saidForMs, ...word }) => ({ ...word, sentForMs: sentForMs(saidForMs) }));
    },
  };
}

interface Watched {
  pulse: number;
  target: number;
  /** How far it went in a tick before the hold. */
  stepBefore: number;
  /** Which way it went when the hold was taken up, and the farthest that it came under the hold. */
  course: number;
  extreme: number;
  isUnderHold: boolean;
}

/** Behind its last byte a hold is taken up by then, and the first tick of it is over. */
const TAKEN_UP_MS = 45;

/**
 * What a servo does is caused by a hold from when the board takes the hold up until it takes up anything else: its own next frame,
 * or what waited in its mailbox.
 */
function watchHolds({ heard, session, channel: { board }, clock }: Rig) {
  const isShared = session.state.family.motion.timing === 'shared';
  const from = heard.length;
  const servos: Watched[] = SERVOS.map((servo) => {
    const pulse = board.pulse(servo);
    return {
      ...{ pulse, target: board.target(servo), stepBefore: 0 },
      ...{ course: 0, extreme: pulse, isUnderHold: false },
    };
  });
  const backBy = SERVOS.map(() => 0);
  let longestStep = 0;

  function latestHold() {
    const since = heard.slice(from);
    const stopAt = since.findIndex(({ command }) => command.kind === 'stop');
    const held =
      stopAt < 0 ? undefined : since.slice(stopAt).findLast(({ command }) => command.kind === 'move');
    return held?.command.kind === 'move' ? { atMs: held.atMs, targets: held.command.targets } : null;
  }

  function take(seen: Watched, isUnderHold: boolean): void {
    seen.isUnderHold = isUnderHold;
    seen.course = Math.sign(seen.target - seen.pulse);
    seen.extreme = seen.pulse;
  }

  function look(): void {
    const hold = latestHold();
    const isTakenUp = hold !== null && clock.now() > hold.atMs + TAKEN_UP_MS && board.runningSlot() === null;
    for (const [index, seen] of servos.entries()) {
      const servo = SERVOS[index] ?? 0;
      const pulse = board.pulse(servo);
      const target = board.target(servo);
      const step = Math.abs(pulse - seen.pulse);
      const wanted = hold?.targets.find((one) => one.servo === servo)?.position;
      if (target !== seen.target) take(seen, wanted === target);
      else if (isTakenUp && !seen.isUnderHold && (wanted === undefined ? isShared : wanted === target))
        take(seen, true);
      else if (seen.isUnderHold) {
        // A way in whole numbers takes one more now and then.
        if (step > seen.stepBefore + 1) longestStep = Math.max(longestStep, step);
        backBy[index] = Math.max(backBy[index] ?? 0, (seen.extreme - pulse) * seen.course);
      } else if (step > 0) seen.stepBefore = step;
      seen.extreme = seen.course > 0 ? Math.max(seen.extreme, pulse) : Math.min(seen.extreme, pulse);
      seen.pulse = pulse;
      seen.target = target;
    }
  }

  return { look, backBy, longestStep: () => longestStep };
}
