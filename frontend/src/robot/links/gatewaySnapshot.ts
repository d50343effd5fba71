// What the gateway says, as the snapshot of its robot; the drawn estimate follows what it says has left and was heard. Knows the messages;
// sends no request to the gateway.

import type { Clock } from '#shared/clock.ts';
import type { Command, Frame } from '#shared/codec/commands.ts';
import { family as familyOf, UNKNOWN_BOARD, type Family } from '#shared/codec/families.ts';
import { fromHex } from '#shared/codec/packet.ts';
import type { Report } from '#shared/codec/reports.ts';
import type { MotionBefore } from '#shared/motion/model.ts';
import { createRobotEstimate, type RobotEstimate } from '#shared/robot/estimate.ts';
import { NOTHING_HEARD } from '#shared/robot/identity.ts';
import type { LineState } from '#shared/robot/link.ts';
import {
  createSessionStore,
  noteCommand,
  noteReport,
  NOTHING_READ,
  type SessionStore,
} from '#shared/robot/store.ts';
import { createMotionLatch, type MotionLatch } from '#shared/robot/latch.ts';
import type { Activity, Battery, LatchReason, LinkState } from '#shared/robot/state.ts';
import type { GatewaySlots } from './gatewaySlots.ts';
import type { Said } from './gatewaySocket.ts';
import {
  boardOf,
  bytesForLog,
  LATCHED_BY,
  motionBefore,
  reportIn,
  type BoardAtGateway,
} from './gatewayValues.ts';
import type { Driving } from './driving.ts';
import type {
  ActivityState,
  BatteryMessage,
  PlayState,
  ShownRun,
  StateMessage,
} from '#shared/client/messages.generated.ts';

export interface GatewaySnapshotOptions {
  readonly clock: Clock;
  readonly driving: Pick<Driving, 'lease' | 'leaseChanged' | 'counted'>;
  readonly slots: Pick<GatewaySlots, 'broken' | 'versions' | 'download' | 'jobChanged' | 'slotsChanged'>;
  /** Moves that were requested and have not left do not leave any more. */
  dropMoves(): void;
  /** Sends a STOP of this page that the gateway has not heard; false where there is none. */
  sendUnheardStop(): boolean;
}

export interface RequestedRuns {
  began(slot: number, times: number): void;
  /** The gateway has answered, or cannot be heard any more. */
  settled(truth: Truth): void;
  refused(): void;
}

type RunActivity = Extract<Activity, { kind: 'running' }>;
type Truth = RunActivity['truth'];

export interface GatewaySnapshot {
  readonly store: SessionStore;
  readonly estimate: RobotEstimate;
  /** Runs that this page requests: how far that is known, until the gateway says that the group runs. */
  readonly runs: RequestedRuns;
  readonly latch: MotionLatch;
  /** Anything moves, or may, as far as the gateway knows. */
  isMoving(): boolean;
  /** This page has the board erase its slots, or not any more. */
  erasing(isErasing: boolean): void;
  /** Why the gateway refuses motion, whatever this page shows; null where it does not. */
  readonly latchedBy: LatchReason | null;
  heard(message: Exclude<Said, { type: 'tick' | 'played' }>): void;
  lineChanged(line: LineState): void;
  /** The download or what the slots hold is another now. */
  slotsChanged(): void;
  stored(slot: number, frames: readonly Frame[]): void;
}

const IDLE: Activity = { kind: 'idle' };

export function createGatewaySnapshot(options: GatewaySnapshotOptions): GatewaySnapshot {
  const { clock, driving, slots } = options;
  const store = createSessionStore({ family: UNKNOWN_BOARD, canShare: true, withheld: [] });
  let estimate = createRobotEstimate(UNKNOWN_BOARD, clock);
  /** Whoever began it. */
  let run: RunActivity | null = null;
  let mayMove = false;
  /** `isPending`: the gateway has not answered yet. */
  let requestedRun: { readonly run: RunActivity; readonly isPending: boolean } | null = null;
  let isErasing = false;
  let isOpen = false;
  /** What the gateway said last, shown while the link is open. */
  let board: BoardAtGateway | null = null;
  let battery: Battery = { kind: 'unread' };
  let document: string | null = null;
  let withheld: StateMessage['port']['withheld'] = [];
  let waitingToStart: readonly number[] = [];
  let mayBeRunning = false;
  let latchedBy: LatchReason | null = null;
  let stoppedBy: string | null = null;
  let play: PlayState | null = null;
  /** Until the link is ready: from then on the estimate follows by itself. */
  let before: MotionBefore | null = null;
  const latch = createMotionLatch({ clock, store, drop, unheldSince: (ms) => estimate.unheldSince(ms, 0) });

  function heard(message: Exclude<Said, { type: 'tick' | 'played' }>): void {
    switch (message.type) {
      case 'welcome':
        driving.leaseChanged(message.lease);
        document = message.robot?.id ?? null;
        before = motionBefore(message.motion, clock.now());
        activityChanged(message.activity);
        slots.jobChanged(message.job);
        play = message.play;
        battery = batteryOf(message.battery, clock.now());
        latchedBy = null;
        stateChanged(message);
        break;
      case 'state':
        stateChanged(message);
        break;
      case 'activity':
        activityChanged(message.activity);
        showActivity();
        break;
      case 'battery':
        battery = batteryOf(message.battery, clock.now());
        if (isOpen) store.update({ battery });
        break;
      case 'robot':
        document = message.robot?.id ?? null;
        if (isOpen) store.update({ robotOnBoard: { document } });
        break;
      case 'resumed':
        if (isOpen) store.emit('resumed', message.by);
        break;
      case 'lease':
        driving.leaseChanged(message.lease);
        showLease();
        break;
      case 'left':
        if (isOpen)
          for (const command of message.commands) {
            left(command);
            if (command.kind === 'move') estimate.headedFor(command.goals);
          }
        break;
      case 'job':
        slots.jobChanged(message.job);
        break;
      case 'play':
        play = message.play;
        showActivity();
        break;
      case 'received':
        if (isOpen) received(reportIn(message), fromHex(message.bytes));
        break;
      case 'noise':
        if (isOpen)
          store.emit('traffic', {
            atMs: clock.now(),
            direction: 'in',
            bytes: fromHex(message.bytes),
            noise: message.reason,
          });
        break;
      case 'halted':
        if (isOpen)
          latch.change({
            stop: message.outcome,
            unheld: message.unheld && { ...message.unheld, forMs: message.unheld.forMs ?? Infinity },
          });
        break;
    }
  }

  function stateChanged(state: Omit<StateMessage, 'type'>): void {
    slots.slotsChanged(state.brokenSlots, state.slotVersions);
    driving.counted(state.clients, state.unattended);
    showLease();
    board = boardOf(state);
    if (isOpen && board !== null) showBoard(board);
    ({ withheld } = state.port);
    ({ waitingToStart, mayBeRunning } = state);
    stoppedBy = state.stoppedBy;
    if (isOpen) {
      store.update({ withheld });
      if (waitingToStart.join() !== store.state.waitingToStart.join()) store.update({ waitingToStart });
      if (mayBeRunning !== store.state.mayBeRunning) store.update({ mayBeRunning });
    }
    latchChanged(state.latchedBy && LATCHED_BY[state.latchedBy]);
  }

  function lineChanged(line: LineState): void {
    isOpen = line.status === 'open';
    if (line.status !== 'open') {
      if (store.state.lease !== null) store.update({ lease: null });
      entered(line);
      return;
    }
    store.update({ battery, withheld, robotOnBoard: { document }, identity: NOTHING_HEARD });
    showLease();
    latchAsGateway();
    if (board !== null) showBoard(board);
    else entered({ status: 'identifying' });
    store.update({ waitingToStart, mayBeRunning });
    showActivity();
  }

  /** The gateway identifies the board: its result counts. */
  function showBoard({ board: id, identity, status, error }: BoardAtGateway): void {
    drive(id === 'unknown' ? UNKNOWN_BOARD : familyOf(id));
    store.update({ identity });
    if (status === 'refused') entered({ status, error });
    else entered(status === 'stale' ? { status, sinceMs: clock.now() } : { status });
  }

  /** The board is taken for something else: whatever was believed of it was about another one. */
  function drive(next: Family): void {
    if (next === store.state.family) return;
    drop();
    estimate = createRobotEstimate(next, clock);
    store.update({
      ...{ family: next, brokenSlots: [], storedSlots: [], lastDownload: null },
      ...NOTHING_READ,
    });
  }

  function entered(next: LinkState): void {
    const previous = store.state.link.status;
    // Its listeners find what is known of its slots and servos.
    if (next.status === 'ready' && previous !== 'ready') becomesReady();
    if (next.status !== 'opening') before = null;
    store.update({ link: next });
    if (next.status === previous) return;
    if (previous === 'ready') unlinked(next);
    showActivity();
  }

  function becomesReady(): void {
    showSlotsOfBoard();
    if (before === null) return;
    estimate.placed(before);
    const reported = before.reported.map(({ servo, position, atMs }) => [servo, { position, atMs }] as const);
    store.update({ reported: Object.fromEntries(reported) });
  }

  /** The board may have moved, restarted or been changed for another before it is ready again. */
  function unlinked(next: LinkState): void {
    estimate.forget(null);
    if (next.status === 'closed') estimate.groupEnded();
    estimate.unstored();
    store.update({ storedSlots: estimate.storedSlots(), mayBeRunning: false, ...NOTHING_READ });
    if (next.status === 'lost' || next.status === 'stale')
      latch.set({ reason: 'reconnected', by: null, stop: 'failed', unheld: estimate.haltPlan(null).unheld });
    else drop();
  }

  /** Requests from here and has not left, or is not known to have ended. */
  function drop(): void {
    options.dropMoves();
    requestedRun = null;
    store.update({ waitingToStart: [] });
    showActivity();
  }

  function showLease(): void {
    const { lease } = driving;
    if (!isOpen || lease === null) return;
    const hasLost = store.state.lease?.drives === true && !lease.drives;
    store.update({ lease });
    if (hasLost) drop();
  }

  function latchElsewhere(reason: LatchReason): void {
    latch.set({ reason, by: stoppedBy, stop: 'sent', unheld: estimate.haltPlan(null).unheld });
  }

  /**
   * Of a link that has opened. What this page moved when it was lost the gateway has stopped, and others may drive since: from here only
   * a STOP is sent that it has not heard.
   */
  function latchAsGateway(): void {
    if (options.sendUnheardStop()) return;
    if (latchedBy !== null) latchElsewhere(latchedBy);
    else if (store.state.latch !== null) latch.clear();
  }

  function latchChanged(next: LatchReason | null): void {
    const isNews = next !== latchedBy;
    latchedBy = next;
    if (isOpen && isNews) {
      if (next === null) latch.clear();
      else if (store.state.latch === null) latchElsewhere(next);
    }
  }

  /** Of a download the gateway says itself how far it is: said late, its frame would pass for one that is being stored now. */
  function left(command: Command): void {
    const bytes = bytesForLog(command, store.state.family);
    if (bytes !== null) store.emit('traffic', { atMs: clock.now(), direction: 'out', bytes, command });
    if (command.kind === 'download') return;
    estimate.applied(command);
    noteCommand(store, command);
  }

  function received(report: Report, bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, report });
    estimate.heard(report);
    noteReport(store, report, clock.now());
    if (report.kind === 'runStopped') latch.change({ stop: 'confirmed' });
  }

  function activityChanged({ running, mayMove: next }: ActivityState): void {
    mayMove = next;
    run = running && runActivity(running);
    if (requestedRun?.isPending !== true) endUnknownRun();
  }

  /** Where its frames are unknown here, so is its end. */
  function endUnknownRun(): void {
    if (run === null && estimate.groupRuns() !== 'no') estimate.groupEnded();
  }

  function runActivity({ slot, times, begunMsAgo, acknowledged }: ShownRun): RunActivity {
    const own = requestedRun?.run;
    const truth = own?.slot === slot && own.times === times ? own.truth : 'requested';
    const sinceMs = clock.now() - begunMsAgo;
    return { kind: 'running', slot, times, sinceMs, truth: acknowledged ? 'acknowledged' : truth };
  }

  function activityNow(): Activity {
    if (isErasing) return { kind: 'erasing' };
    const storing = downloadActivity();
    if (storing.kind !== 'idle' || !isOpen) return storing;
    if (play?.status === 'playing') {
      const { frameIndex, frameCount } = play;
      return { kind: 'playing', frameIndex, frameCount };
    }
    if (store.state.link.status !== 'ready') return IDLE;
    return run ?? (requestedRun?.isPending === true ? requestedRun.run : IDLE);
  }

  function showActivity(): void {
    const next = activityNow();
    if (!isSame(next, store.state.activity)) store.update({ activity: next });
  }

  function downloadActivity(): Activity {
    const { download } = slots;
    if (download === null || download.isOver) return IDLE;
    const { isOver: _, ...progress } = download;
    const slot = progress.slots[Math.min(progress.groupsStored, progress.slots.length - 1)] ?? 0;
    return { kind: 'downloading', slot, ...progress };
  }

  function slotsChanged(): void {
    if (store.state.link.status === 'ready') showSlotsOfBoard();
  }

  function showSlotsOfBoard(): void {
    const { download, broken, versions } = slots;
    if (download !== null) noteDownload(download);
    const brokenSlots = broken.toSorted((a, b) => a - b);
    if (brokenSlots.join() !== store.state.brokenSlots.join()) store.update({ brokenSlots });
    if (versions !== store.state.slotVersions) store.update({ slotVersions: versions });
    showStoredSlots();
    showActivity();
  }

  function showStoredSlots(): void {
    const storedSlots = estimate.storedSlots();
    if (storedSlots.join() !== store.state.storedSlots.join()) store.update({ storedSlots });
  }

  /** What its slots held before is gone, as far as it has come. */
  function noteDownload({ slots: filled, groupsStored, isOver }: NonNullable<typeof slots.download>): void {
    const { lastDownload } = store.state;
    if (!isOver) for (const slot of filled.slice(0, groupsStored + 1)) estimate.unstored(slot);
    const isNews = lastDownload?.groupsStored !== groupsStored || lastDownload.slots.join() !== filled.join();
    if (isOver && isNews) store.update({ lastDownload: { slots: filled, groupsStored } });
  }

  return {
    store,
    get estimate() {
      return estimate;
    },
    runs: {
      began(slot, times) {
        const own = { kind: 'running', slot, times, sinceMs: clock.now(), truth: 'requested' } as const;
        requestedRun = { run: own, isPending: true };
        showActivity();
      },
      settled(truth) {
        if (requestedRun === null) return;
        requestedRun = { run: { ...requestedRun.run, truth }, isPending: false };
        if (run?.truth === 'requested') run = { ...run, truth };
        endUnknownRun();
        showActivity();
      },
      refused() {
        requestedRun = null;
        showActivity();
      },
    },
    isMoving: () => isOpen && mayMove,
    erasing(next) {
      isErasing = next;
      showActivity();
    },
    get latchedBy() {
      return latchedBy;
    },
    ...{ heard, lineChanged, slotsChanged, latch },
    stored(slot, frames) {
      estimate.stored(slot, frames);
      showStoredSlots();
    },
  };
}

function isSame(one: Activity, other: Activity): boolean {
  return JSON.stringify(one) === JSON.stringify(other);
}

function batteryOf(battery: BatteryMessage['battery'], nowMs: number): Battery {
  if (battery.kind !== 'read') return battery;
  return { kind: 'read', batteryMv: battery.batteryMv, atMs: nowMs - battery.ageMs };
}
