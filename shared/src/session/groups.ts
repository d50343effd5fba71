// Action groups in the board's own memory: run, stop, erase, download, and what the board reports of them. Class C
// commands are never repeated by themselves (safety.md section 4). Knows slots; the moves of the page are live.ts.

import type { Command, Frame } from '../protocol/commands.ts';
import type { Report } from '../protocol/reports.ts';
import { requireReady, requireReleased, requireRest, setActivity, type Core } from './core.ts';
import { download, frameCommands } from './download.ts';
import { encodeOrRefuse } from './exchange.ts';
import { repeatStop, STOP_PACKET } from './halt.ts';
import { LinkError } from './linkError.ts';
import type { SlotMemory } from './slotMemory.ts';
import type { Activity } from './state.ts';
import type { SharedSlots } from './transport.ts';
import { EDGE_FRAME_TIMEOUT_MS, ERASE_TIMEOUT_MS, RUN_END_GRACE_MS, RUN_TIMEOUT_MS } from './timings.ts';

export interface Groups {
  run(slot: number, times: number): Promise<void>;
  stop(): Promise<void>;
  /** Its repeats are still to leave. */
  isStopping(): boolean;
  erase(): Promise<void>;
  download(slot: number, frames: readonly Frame[]): Promise<void>;
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

/** `shared`: a link that stores groups by itself, and remembers which slots are broken. */
export function createGroups(
  core: Core,
  ownMemory: SlotMemory | undefined,
  shared: SharedSlots | undefined,
): Groups {
  const slotMemory = shared === undefined ? ownMemory : undefined;
  const { family, clock, store, robot, lanes, exchange } = core;
  const broken = new Set<number>();
  let stopping = 0;
  let isCancelled = false;
  let cancelEndTimer = (): void => undefined;
  /** Until then the board may acknowledge a frame that nobody waits for any more. */
  let owedUntilMs = 0;

  function publishSlots(): void {
    const brokenSlots = [...broken].sort((a, b) => a - b);
    slotMemory?.write(brokenSlots);
    store.update({ brokenSlots, storedSlots: robot.storedSlots() });
  }

  /** Which board it is becomes known only now: another one may have taken the name's place. */
  function linked(): void {
    const remembered = shared?.broken ?? slotMemory?.read();
    const work = sharedWork();
    const isSame = remembered?.length === broken.size && remembered.every((slot) => broken.has(slot));
    if (remembered !== undefined && !isSame) {
      broken.clear();
      for (const slot of remembered) broken.add(slot);
      publishSlots();
    }
    const { kind } = store.state.activity;
    if (shared !== undefined && (kind === 'idle' || kind === 'downloading')) setActivity(core, work);
  }

  function sharedWork(): Activity {
    const under = shared?.download ?? null;
    if (under !== null) robot.unstored(under.slot);
    return under === null ? IDLE : { kind: 'downloading', ...under };
  }

  function began(slot: number, times: number, truth: Truth): void {
    setActivity(core, { kind: 'running', slot, times, sinceMs: clock.now(), truth });
    cancelEndTimer();
    const passMs = robot.groupMs(slot);
    if (times === 0 || passMs === null) return;
    // The board's own word for the end may be lost on the way.
    cancelEndTimer = clock.after(passMs * times + RUN_END_GRACE_MS, () => ended(null));
  }

  function ended(slot: number | null): void {
    cancelEndTimer();
    robot.groupEnded(slot);
    if (store.state.activity.kind === 'running') setActivity(core, IDLE);
  }

  async function stop(): Promise<void> {
    requireReady(core.store);
    stopping += 1;
    try {
      await repeatStop(clock, () => lanes.stop(STOP_PACKET));
    } finally {
      stopping -= 1;
    }
    ended(null);
  }

  async function run(slot: number, times: number): Promise<void> {
    requireReleased(core);
    const command = { kind: 'run', slot, times } as const;
    encodeOrRefuse(command, family);
    if (broken.has(slot))
      throw new LinkError('slotBroken', `slot ${slot} holds half a group: download it again`);
    if (store.state.activity.kind === 'playing')
      throw new LinkError('busy', 'the page is playing: stop it first');
    if (store.state.activity.kind === 'running') {
      await stop();
      // Somebody may have pressed STOP meanwhile.
      requireReleased(core);
    }
    began(slot, times, 'requested');
    try {
      await begin(command);
    } catch (error) {
      if (error instanceof LinkError && error.code === 'overslept') ended(null);
      else confirm('unknown');
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
    const command = { kind: 'erase' } as const;
    encodeOrRefuse(command, family);
    setActivity(core, { kind: 'erasing' });
    robot.unstored();
    try {
      await exchange.ask(command, 'erased', ERASE_TIMEOUT_MS);
      broken.clear();
    } finally {
      publishSlots();
      setActivity(core, IDLE);
    }
  }

  async function storeGroup(slot: number, frames: readonly Frame[]): Promise<void> {
    requireRest(core);
    if (shared !== undefined) {
      for (const command of frameCommands({ slot, frames })) encodeOrRefuse(command, family);
      await shared.store(slot, frames);
      robot.stored(slot, frames);
      publishSlots();
      return;
    }
    isCancelled = false;
    const owedForMs = Math.max(0, owedUntilMs - clock.now());
    try {
      await download({
        ...{ slot, frames, family, clock, exchange, owedForMs },
        isCancelled: () => isCancelled,
        begun() {
          robot.unstored(slot);
          broken.add(slot);
          publishSlots();
        },
        progress: (progress) => setActivity(core, { kind: 'downloading', slot, ...progress }),
      });
      robot.stored(slot, frames);
      broken.delete(slot);
      owedUntilMs = 0;
    } catch (error) {
      owedUntilMs = clock.now() + EDGE_FRAME_TIMEOUT_MS;
      throw error;
    } finally {
      publishSlots();
      if (store.state.activity.kind === 'downloading') setActivity(core, IDLE);
    }
  }

  return {
    run,
    stop,
    isStopping: () => stopping > 0,
    erase,
    download: storeGroup,
    async cancelDownload() {
      isCancelled = true;
      await shared?.cancel();
    },
    heard(report) {
      robot.heard(report);
      if (report.kind === 'runStarted') began(report.slot, report.times, 'acknowledged');
      if (report.kind === 'runFinished') ended(report.slot);
      if (report.kind === 'runStopped') ended(null);
    },
    linked,
    unlinked() {
      robot.unstored();
      publishSlots();
    },
    drop() {
      cancelEndTimer();
      return sharedWork();
    },
  };
}
