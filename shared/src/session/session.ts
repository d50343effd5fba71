// One session per link: what should happen, in what order, and what came back. Puts together the link, the outgoing
// lanes, the replies and the estimate of the robot. Knows no transport by name and no user interface.

import type { Clock } from '../clock.ts';
import type { Command, Frame, ServoTarget } from '../protocol/commands.ts';
import type { Family } from '../protocol/families.ts';
import { parseCommand } from '../protocol/parse.ts';
import type { Report } from '../protocol/reports.ts';
import { createBatteryReader } from './batteryReader.ts';
import type { Core } from './core.ts';
import type { CancelSignal } from './download.ts';
import { createExchange, encodeOrRefuse } from './exchange.ts';
import { createGroups } from './groups.ts';
import { createHalt } from './halt.ts';
import { createLanes } from './lanes.ts';
import { createLink } from './link.ts';
import { LinkError } from './linkError.ts';
import { createLive } from './live.ts';
import { createMoveBuffer } from './moveBuffer.ts';
import { createReceiver } from './receiver.ts';
import { createReplies } from './replies.ts';
import { createRobotEstimate } from './robot.ts';
import { createResync } from './resync.ts';
import type { LinkState, ServoMotion, SessionEvents, SessionState } from './state.ts';
import type { SlotMemory } from './slotMemory.ts';
import { createSessionStore } from './store.ts';
import type { Transport } from './transport.ts';

export interface SessionOptions {
  readonly transport: Transport;
  readonly family: Family;
  readonly clock: Clock;
  /** Without it broken slots are forgotten with the session. */
  readonly slotMemory?: SlotMemory | undefined;
}

/** Every operation throws or rejects with a LinkError; see linkError.ts for the codes. */
export interface Session {
  readonly family: Family;
  readonly state: SessionState;
  subscribe(listener: Partial<SessionEvents>): () => void;
  /** Rejects when the first attempt fails; a failure that passes by itself is tried again nevertheless. */
  open(): Promise<void>;
  close(): Promise<void>;
  retryNow(): void;
  /** Newest wins per servo. Positions in the family's unit; `durationMs` 0 is as fast as the link allows. */
  move(targets: readonly ServoTarget[], durationMs: number): void;
  /** `times` 0 repeats until stopped. A group that runs already is stopped first (S45, S46). */
  run(slot: number, times: number): Promise<void>;
  /** Ends the running group after its frame in progress. Leaves everything else free to move. */
  stopGroup(): Promise<void>;
  /** STOP: see safety.md section 1. Resolves when the whole sequence has left the wire. */
  halt(): Promise<void>;
  /** Allows motion again. Moves nothing. */
  resume(): Promise<void>;
  /** Erases every slot of the board. */
  erase(): Promise<void>;
  /** Millivolts. */
  readBattery(): Promise<number>;
  /** Stores `frames` in `slot`; progress is in `state.activity`. */
  download(slot: number, frames: readonly Frame[], signal?: CancelSignal): Promise<void>;
  /** Plays from the page. Resolves at the end or after `stopPlaying`. */
  play(frames: readonly Frame[], options?: { readonly times?: number }): Promise<void>;
  stopPlaying(): void;
  motion(servo: number): ServoMotion;
}

export function createSession({ transport, family, clock, slotMemory }: SessionOptions): Session {
  const store = createSessionStore();
  const robot = createRobotEstimate(family, clock);
  const replies = createReplies(clock);
  const moves = createMoveBuffer(family);

  const link = createLink({
    transport,
    clock,
    received: (bytes, whole = false) => receiver.push(bytes, whole),
    changed: linkChanged,
    returned: () => halt.stopAfterReturn(),
    latched(latched) {
      if (!latched) halt.released();
      else if (store.state.latch === null) halt.latchedElsewhere();
    },
  });

  const lanes = createLanes({
    clock,
    serviceGapMs: family.serviceGapMs,
    send: link.send,
    takeMove() {
      const move = moves.take();
      return move && encodeOrRefuse(robot.softened(move), family);
    },
    leaving: note,
    sent: take,
    moveFailed: (error) => store.emit('problem', error),
  });

  const core: Core = {
    family,
    clock,
    store,
    robot,
    lanes,
    exchange: createExchange(family, clock, lanes, replies),
  };
  const live = createLive(core, moves);
  const groups = createGroups(core, slotMemory);
  const readBattery = createBatteryReader(core);
  const halt = createHalt(core, { transport, dropAll, sentByOthers });
  const resync = createResync(core);
  const receiver = createReceiver({ clock, family, report: heard, noise: heardNoise });

  /** Into the log when it begins to leave, so that its answer comes after it. */
  function note(packet: Uint8Array): void {
    const command = commandIn(packet);
    if (command !== null)
      store.emit('traffic', { atMs: clock.now(), direction: 'out', bytes: packet, command });
  }

  /** Into the estimate when it has left: not before can the board act on it. */
  function take(packet: Uint8Array): void {
    const command = commandIn(packet);
    if (command !== null) robot.applied(command);
  }

  function sentByOthers(packet: Uint8Array): void {
    note(packet);
    take(packet);
  }

  function heard(report: Report, bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, report });
    lanes.answered(bytes[3] ?? 0);
    replies.deliver(report);
    groups.heard(report);
    if (report.kind === 'runStopped') halt.confirmed();
  }

  function heardNoise(noise: 'garbage' | 'truncated', bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, noise });
  }

  function linkChanged(state: LinkState): void {
    const wasReady = store.state.link.status === 'ready';
    store.update({ link: state });
    if (state.status === 'ready') linked();
    if (wasReady) unlinked(state);
  }

  function linked(): void {
    groups.linked();
    resync.send();
  }

  function unlinked(state: LinkState): void {
    const packet = lanes.unfinished();
    // A shared link has its own way to mend the wire behind it.
    if (packet !== null && transport.halt === undefined) resync.cut(packet);
    receiver.reset();
    robot.forget();
    groups.unlinked();
    if (state.status === 'lost') halt.latchedByLoss();
    else dropAll(new LinkError('closed', 'the link was closed'));
  }

  /** Ends what is under way. Whatever the board was asked and did not answer stays unknown. */
  function dropAll(error: LinkError): void {
    live.drop();
    groups.drop();
    lanes.purge(error);
    replies.fail(error);
    store.update({ activity: { kind: 'idle' } });
  }

  return {
    family,
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
    move: live.move,
    run: groups.run,
    stopGroup: groups.stop,
    halt: halt.halt,
    resume: halt.resume,
    erase: groups.erase,
    readBattery,
    download: (slot, frames, signal) => groups.download(slot, frames, signal),
    play: (frames, options) => live.play(frames, options?.times ?? 1),
    stopPlaying: live.stopPlaying,
    motion: robot.motion,
  };
}

function commandIn(packet: Uint8Array): Command | null {
  return parseCommand({ command: packet[3] ?? 0, params: packet.subarray(4) });
}
