// The window's time under test: timers, frames and dates of the page go by a virtual clock that only tests move. Imported
// before the page's code, so that no library keeps the browser's own.

import type { Clock } from '#shared/clock.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';

/** A display of 20 frames a second: each of them costs as much as on a real one. */
export const FRAME_MS = 48;
/** A weekday at noon, the same for every test. */
const STARTED_AT_EPOCH_MS = Date.UTC(2026, 0, 14, 12);

const real = {
  setTimeout: window.setTimeout.bind(window),
  frame: window.requestAnimationFrame.bind(window),
};
const clock = createVirtualClock();
/** The page's own timers: they end with it, what is outside of it goes on. */
const timers = new Map<number, () => void>();
let lastTimer = 0;

/** For what is outside of the page, like its robot. */
export const worldClock: Clock = clock;

/** On the tests' wall clock, where the window's time begins. */
export const timeOriginMs = STARTED_AT_EPOCH_MS;

function after(delayMs: number, run: () => void): number {
  const id = (lastTimer += 1);
  const cancel = clock.after(delayMs, () => {
    timers.delete(id);
    run();
  });
  timers.set(id, cancel);
  return id;
}

function cancel(id: number | undefined): void {
  timers.get(id ?? 0)?.();
  timers.delete(id ?? 0);
}

function every(delayMs: number, run: () => void, id = (lastTimer += 1)): number {
  const next = clock.after(Math.max(1, delayMs), () => {
    every(delayMs, run, id);
    run();
  });
  timers.set(id, next);
  return id;
}

/** Forgets all timers of a page that is left. */
export function endTimers(): void {
  for (const cancelOne of timers.values()) cancelOne();
  timers.clear();
}

type Run = (...args: unknown[]) => void;

function virtualDate(): DateConstructor {
  const now = (): number => STARTED_AT_EPOCH_MS + clock.now();
  return new Proxy(Date, {
    construct: (target, args: unknown[], wanted) =>
      Reflect.construct(target, args.length === 0 ? [now()] : args, wanted) as Date,
    apply: () => new Date(now()).toString(),
    get: (target, name, receiver) =>
      name === 'now' ? now : (Reflect.get(target, name, receiver) as unknown),
  });
}

Object.assign(window, {
  setTimeout: (run: Run, delayMs = 0, ...args: unknown[]) => after(delayMs, () => run(...args)),
  clearTimeout: cancel,
  setInterval: (run: Run, delayMs = 0, ...args: unknown[]) => every(delayMs, () => run(...args)),
  clearInterval: cancel,
  requestAnimationFrame: (draw: FrameRequestCallback) =>
    after(FRAME_MS - (clock.now() % FRAME_MS), () => draw(clock.now())),
  cancelAnimationFrame: cancel,
  Date: virtualDate(),
});
performance.now = clock.now;

const channel = new MessageChannel();
const waiting: (() => void)[] = [];
channel.port1.onmessage = () => waiting.shift()?.();

/** One turn of the browser's own loop: React draws, and messages of workers and databases arrive. */
export function turn(): Promise<void> {
  return new Promise((resolve) => {
    waiting.push(resolve);
    channel.port2.postMessage(null);
  });
}

/** What the browser answers in real time, and the page waits for by its clock. */
const answers = new Set<Promise<unknown>>();

/** Time stands still until then. */
export function standStillFor(answer: Promise<unknown>): void {
  answers.add(answer);
  const come = (): void => void answers.delete(answer);
  answer.then(come, come);
}

/** Time passes frame by frame, and the page is drawn in each. */
export async function advance(ms: number): Promise<void> {
  for (let left = ms; left > 0; left -= FRAME_MS) {
    await Promise.allSettled(answers);
    await clock.advance(Math.min(FRAME_MS, left));
    await turn();
  }
}

/** What no clock moves: layout that is observed, workers, the browser's database. */
export const realMoment = (ms = 4): Promise<void> => new Promise((resolve) => real.setTimeout(resolve, ms));

/** Until the browser has drawn, and observers of sizes and sight were called. */
export const realFrame = (): Promise<void> =>
  new Promise((resolve) => real.frame(() => real.setTimeout(resolve, 0)));

const USUAL_WITHIN_MS = 5000;
/** How often work beside the page is waited for, 7 s in all: turns, which come later on a busy machine, and not a time. */
const TURNS_BESIDE = 220;
const BESIDE_EACH_MS = 32;
let turnsBeside = 0;
let turnBeside: Promise<void> | null = null;

/** Shared by all waits, also by those within each other. */
function nextTurnBeside(): Promise<void> {
  turnBeside ??= realMoment(BESIDE_EACH_MS).then(() => {
    turnsBeside += 1;
    turnBeside = null;
  });
  return turnBeside;
}

/** Lets time pass until `check` throws no more; rejects with what it threw last. */
export async function eventually<T>(check: () => T | Promise<T>, withinMs = USUAL_WITHIN_MS): Promise<T> {
  const begun = { atMs: clock.now(), turns: turnsBeside };
  for (let tries = 0; ; tries += 1) {
    // By the clock: what is waited for may itself wait.
    let passedMs: number;
    try {
      return await check();
    } catch (error) {
      passedMs = clock.now() - begun.atMs;
      if (passedMs >= withinMs && turnsBeside - begun.turns >= TURNS_BESIDE) throw error;
    }
    const stepMs = passedMs < 10 * FRAME_MS || passedMs >= withinMs ? FRAME_MS : 3 * FRAME_MS;
    await advance(stepMs);
    // Then only work beside the page is waited for, and little of the page's own time goes by meanwhile: on a fast machine, too.
    if (passedMs + stepMs >= withinMs) await nextTurnBeside();
    else if (tries % 8 === 7) await realMoment();
  }
}

/** Lets time pass while something else needs it. */
export async function during<T>(work: Promise<T>): Promise<T> {
  const state = { isDone: false };
  const ended = (): void => void (state.isDone = true);
  work.then(ended, ended);
  await turn();
  while (!state.isDone) {
    await advance(FRAME_MS);
    await realMoment(0);
  }
  return work;
}
