// Action groups in the board's own memory: run, stop, erase, download, and what the board reports of them. Class C
// commands are never repeated by themselves (safety.md section 4). Knows slots; the moves of the page are live.ts.

import type { Command } from '../codec/commands.ts';
import type { Report } from '../codec/reports.ts';
import {
  requireCarried,
  requireReady,
  requireReleased,
  requireRest,
  setActivity,
  type Core,
} from './core.ts';
import { refuseUnfit } from './exchange.ts';
import { repeatStop } from './halt.ts';
import { LinkError, type LinkErrorCode } from './linkError.ts';
import type { SlotMemory } from './slotMemory.ts';
import type { Activity } from './state.ts';
import { createStoring } from './storing.ts';
import type { SharedCommands, SharedSlots, SlotGroup } from './transport.ts';
import { ERASE_TIMEOUT_MS, RUN_END_GRACE_MS, RUN_TIMEOUT_MS } from './timings.ts';

export interface Groups {
  run(slot: number, times: number): Promise<void>;
  stop(): Promise<void>;
  /** Its repeats are still to leave. */
  isStopping(): boolean;
  erase(): Promise<void>;
  download(groups: readonly SlotGroup[]): Promise<void>;
  cancelDownload(): Promise<void>;
  heard(report: Report): void;
  /** The link is about to be ready, or what it shares has changed: what is known of this board's slots. */
  linked(): void;
  /** The link is gone: what this board holds, or whether it is the same one at its return, nobody knows. */
  unlinked(): void;
  /** What goes on nevertheless. */
  drop(): Activity;
}

type Truth = Extract<Activity, { kind: 'running' }>['truth'];

const IDLE: Activity = { kind: 'idle' };
/** Whether the board has heard it nobody can say then. */
const UNKNOWN: readonly LinkErrorCode[] = ['noAnswer', 'lost', 'gatewayUnreachable'];

const isUnknown = ({ code }: LinkError): boolean => UNKNOWN.includes(code);

/** `shared`: a link that stores groups by itself, and remembers which slots are broken. */
export function createGroups(
  core: Core,
  ownMemory: SlotMemory | undefined,
  shared: SharedSlots | undefined,
): Groups {
  const { family, clock, store, robot, lanes, exchange, commands } = core;
  const storing = createStoring(core, ownMemory, shared);
  let stopping: Promise<void> | null = null;
  let cancelEndTimer = (): void => undefined;

  function began(slot: number, times: number, truth: Truth): void {
    setActivity(core, { kind: 'running', slot, times, sinceMs: clock.now(), truth });
    cancelEndTimer();
    const passMs = robot.groupMs(slot);
    if (times === 0 || passMs === null) return;
    // The board's own word for the end may be lost on the way.
    cancelEndTimer = clock.after(passMs * times + RUN_END_GRACE_MS, assumeEnded);
  }

  function assumeEnded(): void {
    robot.groupEnded();
    ended();
  }

  function ended(): void {
    cancelEndTimer();
    if (store.state.activity.kind === 'running') setActivity(core, IDLE);
  }

  /** Pressed again, it says so at once and again. */
  async function stop(): Promise<void> {
    requireReady(core.store);
    if (commands === undefined) return stopHere();
    await commands.stopGroup();
    ended();
  }

  async function stopHere(): Promise<void> {
    const repeats = repeatStop(clock, lanes);
    stopping = repeats;
    try {
      await repeats;
    } finally {
      if (stopping === repeats) stopping = null;
    }
    ended();
  }

  async function run(slot: number, times: number): Promise<void> {
    requireReleased(core);
    const command = { kind: 'run', slot, times } as const;
    refuseUnfit(command, family);
    if (storing.isBroken(slot))
      throw new LinkError('slotBroken', `slot ${slot} holds half a group: download it again`);
    if (store.state.activity.kind === 'playing')
      throw new LinkError('busy', 'the page is playing: stop it first');
    if (commands !== undefined) return runThere(commands, slot, times);
    if (stopping !== null || store.state.activity.kind === 'running') {
      // One that left between the repeats of a stop would be ended by the last one.
      await (stopping ?? stop());
      // Somebody may have pressed STOP meanwhile.
      requireReleased(core);
    }
    began(slot, times, 'requested');
    try {
      await begin(command);
    } catch (error) {
      if (error instanceof LinkError && error.code === 'overslept') ended();
      else confirm('unknown');
      throw error;
    }
  }

  /** There what moves ends first. */
  async function runThere(there: SharedCommands, slot: number, times: number): Promise<void> {
    began(slot, times, 'requested');
    try {
      const outcome = await there.run(slot, times);
      if (outcome === 'acknowledged') confirm(outcome);
      if (outcome === 'silent') throw new LinkError('noAnswer', 'the board did not say that it runs it');
    } catch (error) {
      if (error instanceof LinkError && isUnknown(error)) confirm('unknown');
      else ended();
      throw error;
    }
  }

  async function begin(command: Command): Promise<void> {
    if (!family.answers.includes('run')) return exchange.tell(command);
    await exchange.ask(command, 'runAccepted', RUN_TIMEOUT_MS);
    confirm('acknowledged');
  }

  function confirm(truth: Truth): void {
    const { activity } = store.state;
    if (activity.kind === 'running') setActivity(core, { ...activity, truth });
  }

  async function erase(): Promise<void> {
    requireRest(core);
    requireCarried(core, 'erase');
    const command = { kind: 'erase' } as const;
    refuseUnfit(command, family);
    setActivity(core, { kind: 'erasing' });
    robot.unstored();
    try {
      await (commands?.erase() ?? exchange.ask(command, 'erased', ERASE_TIMEOUT_MS));
      storing.emptied();
    } finally {
      storing.publish();
      setActivity(core, IDLE);
    }
  }

  return {
    run,
    stop,
    isStopping: () => stopping !== null,
    erase,
    download: storing.store,
    cancelDownload: storing.cancel,
    heard(report) {
      robot.heard(report);
      if (report.kind === 'runStarted') began(report.slot, report.times, 'acknowledged');
      if (report.kind === 'runFinished' || report.kind === 'runStopped') ended();
    },
    linked: storing.linked,
    unlinked() {
      robot.unstored();
      storing.publish();
    },
    drop() {
      cancelEndTimer();
      return storing.work();
    },
  };
}
