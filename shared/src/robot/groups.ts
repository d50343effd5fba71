// Action groups in the board's own memory: run, stop, erase, their speed, download. Class C commands are never repeated by themselves
// (safety.md section 4). Knows slots; the moves of the page are moveBuffer.ts.

import type { BatteryGuard } from './batteryGuard.ts';
import type { Command } from '../codec/commands.ts';
import type { Report } from '../codec/reports.ts';
import { requireAtRest, setActivity, type Core } from './core.ts';
import { LinkError } from './linkError.ts';
import { refuseUnfit, requireCarried, requireReady, requireReleased, requireRunnable } from './rules.ts';
import { createRunning } from './store.ts';
import { repeatStop } from './halt.ts';
import { createStoring, type SlotMemory, type Storing } from './download.ts';
import { ERASE_TIMEOUT_MS, RUN_TIMEOUT_MS } from './timings.ts';

export interface Groups extends Pick<Storing, 'store' | 'cancel' | 'linked'> {
  /** `anyway`: also where the battery is at its alarm. */
  run(slot: number, times: number, anyway?: boolean): Promise<void>;
  stop(): Promise<void>;
  /** Its repeats are still to leave. */
  isStopping(): boolean;
  erase(): Promise<void>;
  /** How fast the board plays the group in `slot`, null for every group, until it is switched off (X3). */
  setSpeed(slot: number | null, percent: number): Promise<void>;
  heard(report: Report): void;
  /** The link is gone: what this board holds, or whether it is the same one at its return, is unknown. */
  unlinked(): void;
  drop(): void;
}

export function createGroups(core: Core, slotMemory: SlotMemory | undefined, guard: BatteryGuard): Groups {
  const { family, clock, store, estimate, queue, exchange } = core;
  const storing = createStoring(core, slotMemory);
  const running = createRunning(clock, store, () => estimate);
  let stopping: Promise<void> | null = null;
  /** Requested runs and stops: a run that waits for a stop is overtaken by a later request. */
  let requests = 0;

  /** Pressed again, it stops at once and again. Only behind all of it another group may begin. */
  async function end(): Promise<void> {
    requireReady(store.state);
    const mine = repeatStop(clock, queue.stop)
      .then(running.ended)
      .finally(() => {
        if (stopping === mine) stopping = null;
      });
    stopping = mine;
    await mine;
  }

  async function stop(): Promise<void> {
    requests += 1;
    const mine = requests;
    await end();
    const isWanted = (): boolean =>
      mine === requests && store.state.activity.kind === 'idle' && !core.isUnsettled();
    core.insistOnEnd(isWanted).catch(() => undefined);
  }

  async function run(slot: number, times: number, anyway = false): Promise<void> {
    requireRunnable(store.state, slot, times);
    requests += 1;
    const mine = requests;
    // One that left between the repeats of a stop would be ended by the last one.
    if (stopping !== null) await stopping;
    if (!anyway && guard.mustAsk()) await askBattery();
    if (!anyway) guard.judge();
    // The frames of the group would make what is under way faster (S26).
    const mayMove = (): boolean => estimate.movesForMs() > 0 || core.isUnsettled();
    if (store.state.activity.kind === 'running' || mayMove()) await core.endMotion();
    // STOP may have been pressed meanwhile.
    requireReleased(store.state);
    if (mine !== requests)
      throw new LinkError('cancelled', 'another group or a stop was requested meanwhile');
    running.began(slot, times, 'requested');
    try {
      await begin({ kind: 'run', slot, times });
    } catch (error) {
      if (error instanceof LinkError && error.code === 'overslept') running.ended();
      else running.confirm('unknown');
      throw error;
    } finally {
      running.follow();
    }
  }

  /** What moves is ended first only where it keeps the board from being asked. */
  async function askBattery(): Promise<void> {
    if (!guard.mayAsk()) await core.endMotion();
    await guard.ask();
  }

  async function begin(command: Command): Promise<void> {
    if (!family.answers.includes('run')) return exchange.send(command);
    await exchange.ask(command, 'runAccepted', RUN_TIMEOUT_MS);
    running.confirm('acknowledged');
  }

  async function erase(): Promise<void> {
    requireAtRest(core);
    requireCarried(store.state, 'erase');
    const command = { kind: 'erase' } as const;
    refuseUnfit(command, family);
    setActivity(core, { kind: 'erasing' });
    estimate.unstored();
    try {
      await exchange.ask(command, 'erased', ERASE_TIMEOUT_MS);
      storing.emptied();
    } finally {
      storing.publish();
      setActivity(core, { kind: 'idle' });
    }
  }

  /** Without an answer, and never repeated by itself: it changes a group that runs (safety.md section 4, class C). */
  async function setSpeed(slot: number | null, percent: number): Promise<void> {
    requireReleased(store.state);
    await exchange.send({ kind: 'setSpeed', slot, percent });
  }

  return {
    run,
    stop,
    isStopping: () => stopping !== null,
    erase,
    setSpeed,
    store: storing.store,
    cancel: storing.cancel,
    linked: storing.linked,
    heard(report) {
      estimate.heard(report);
      if (report.kind === 'runStarted') {
        running.began(report.slot, report.times, 'acknowledged');
        running.follow();
      }
      if (report.kind === 'runFinished' || report.kind === 'runStopped') running.ended();
    },
    unlinked() {
      estimate.unstored();
      storing.publish();
    },
    drop: running.forget,
  };
}
