// A robot at the gateway: intents become messages, messages become the snapshot, and the drawn estimate follows what the gateway says
// has left and was heard. Holds no queue; what may be done, and when, the gateway decides. Only what its last word forbids already is
// not asked for.

import type { Clock } from '#shared/clock.ts';
import type { Command } from '#shared/codec/commands.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { family as familyOf, FAMILIES, UNKNOWN_BOARD, type Family } from '#shared/codec/families.ts';
import { fromHex } from '#shared/codec/packet.ts';
import type { Report } from '#shared/codec/reports.ts';
import type { MotionBefore } from '#shared/motion/before.ts';
import { createRobotEstimate } from '#shared/robot/estimate.ts';
import { NOTHING_HEARD } from '#shared/robot/identity.ts';
import type { LineState } from '#shared/robot/link.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import type { Robot } from '#shared/robot/robot.ts';
import {
  encodeOrRefuse,
  frameCommands,
  refuseUnfit,
  releaseCommands,
  requireCarried,
  requireIdle,
  requireLine,
  requireQuestion,
  requireReady,
  requireReleased,
  requireRest,
  requireRunnable,
} from '#shared/robot/rules.ts';
import { createRunning } from '#shared/robot/running.ts';
import type {
  Activity,
  Battery,
  HaltReason,
  Latch,
  LatchReason,
  LinkState,
  SlotGroup,
} from '#shared/robot/state.ts';
import { createSessionStore, noteCommand, noteReport, NOTHING_READ } from '#shared/robot/store.ts';
import { createGatewayLink } from './links/gatewayLink.ts';
import { createGatewayMoves } from './links/gatewayMoves.ts';
import type { GatewayPlayer } from './links/gatewayPlayer.ts';
import { createGatewaySlots } from './links/gatewaySlots.ts';
import { createGatewaySocket, type Outcome, type Said } from './links/gatewaySocket.ts';
import {
  batteryOf,
  boardOf,
  compactHex,
  isHarmlessPacket,
  LATCHED_BY,
  motionBefore,
  reportIn,
  type BoardAtGateway,
} from './links/gatewayValues.ts';
import { createDriving } from './links/lease.ts';
import type { ClientMessage, PlayState, StateMessage } from './links/messages.generated.ts';

export interface GatewayRobotOptions {
  /** The gateway's WebSocket, e.g. `ws://127.0.0.1:8300/ws`. */
  readonly url: string;
  readonly clock: Clock;
  /** A viewer calibrates nothing. */
  readonly mayDrive?: boolean;
}

export interface GatewayRobot extends Robot {
  /** Names the gateway's port for people; known once it is open, else empty. */
  readonly label: string;
  /** No real board is behind it. */
  readonly isSimulated: boolean;
}

const IDLE: Activity = { kind: 'idle' };
/** Whether the board has heard of a run is unknown then. */
const UNCERTAIN: readonly LinkErrorCode[] = ['noAnswer', 'lost', 'gatewayUnreachable'];

export function createGatewayRobot({ url, clock, mayDrive = true }: GatewayRobotOptions): GatewayRobot {
  const store = createSessionStore({ family: UNKNOWN_BOARD, canShare: true, withheld: [] });
  let estimate = createRobotEstimate(UNKNOWN_BOARD, clock);
  /** What the gateway said last, shown while the link is open. */
  let board: BoardAtGateway | null = null;
  let battery: Battery = { kind: 'unread' };
  let document: string | null = null;
  let waitingToStart: readonly number[] = [];
  let latchedBy: LatchReason | null = null;
  let stoppedBy: string | null = null;
  let play: PlayState | null = null;
  /** Until the link is ready: from then on the estimate follows by itself. */
  let before: MotionBefore | null = null;
  let latches = 0;
  let pressedMs = 0;
  /** Of the stop under way. */
  let stopping: Promise<unknown> = Promise.resolve();
  /** Why STOP was pressed here, where the gateway was not there to hear it. */
  let unheard: HaltReason | null = null;
  let batteryAsked: Promise<number> | null = null;
  /** Comes when it is first asked for. */
  let player: Promise<GatewayPlayer> | null = null;
  let playId = 0;

  const socket = createGatewaySocket({ url, heard, refused, gone: (error) => link.socketGone(error) });
  const link = createGatewayLink({ clock, socket, changed: linkChanged, lost });
  const driving = createDriving(socket.post, clock.now);
  const slots = createGatewaySlots(begin, showSlots);
  const moves = createGatewayMoves({
    ...{ clock, begin, post: socket.post, nextId: socket.nextId },
    failed: (error) => store.emit('problem', error),
  });
  const running = createRunning(clock, store, () => estimate);

  /** Of the page's lease, for what is asked now. */
  async function begin(withinMs?: number): Promise<string> {
    await driving.begin(withinMs);
    return driving.nonce ?? '';
  }

  async function askDriving(message: (id: number, nonce: string) => ClientMessage): Promise<Outcome> {
    const nonce = await begin();
    return socket.ask((id) => message(id, nonce));
  }

  function heard(message: Said): void {
    switch (message.type) {
      case 'welcome':
        driving.leaseChanged(message.lease);
        document = message.robot?.id ?? null;
        before = motionBefore(message.motion);
        slots.jobChanged(message.job);
        play = message.play;
        battery = batteryOf(message.battery, clock.now());
        latchedBy = null;
        stateChanged(message);
        break;
      case 'state':
        stateChanged(message);
        break;
      case 'battery':
        battery = batteryOf(message.battery, clock.now());
        if (link.isOpen) store.update({ battery });
        break;
      case 'robot':
        document = message.robot?.id ?? null;
        if (link.isOpen) store.update({ robotOnBoard: { document } });
        break;
      case 'resumed':
        if (link.isOpen) store.emit('resumed', message.by);
        break;
      case 'lease':
        driving.leaseChanged(message.lease);
        showLease();
        break;
      case 'left':
        if (link.isOpen) message.commands.forEach(left);
        break;
      case 'job':
        slots.jobChanged(message.job);
        break;
      case 'play':
        play = message.play;
        showPlay();
        break;
      case 'played':
        withPlayer((one) => one.ended(message));
        break;
      case 'tick':
        driving.ticked(message.nonce);
        break;
      case 'received':
        if (link.isOpen) received(reportIn(message), fromHex(message.bytes));
        break;
      case 'noise':
        if (link.isOpen)
          store.emit('traffic', {
            atMs: clock.now(),
            direction: 'in',
            bytes: fromHex(message.bytes),
            noise: message.reason,
          });
        break;
      case 'halted':
        if (link.isOpen)
          changeLatch({
            stop: 'sent',
            unheld: message.unheld && { ...message.unheld, forMs: message.unheld.forMs ?? Infinity },
          });
        socket.settle('halted');
        break;
    }
  }

  function stateChanged(state: Omit<StateMessage, 'type'>): void {
    slots.slotsChanged(state.brokenSlots, state.slotVersions);
    driving.counted(state.clients, state.unattended);
    showLease();
    board = boardOf(state);
    if (link.isOpen && board !== null) showBoard(board);
    link.portChanged(state.port);
    waitingToStart = state.waitingToStart;
    stoppedBy = state.stoppedBy;
    if (link.isOpen) {
      store.update({ withheld: state.port.withheld });
      if (waitingToStart.join() !== store.state.waitingToStart.join()) store.update({ waitingToStart });
    }
    latchChanged(state.latchedBy && LATCHED_BY[state.latchedBy]);
  }

  function linkChanged(line: LineState): void {
    if (line.status !== 'open') {
      if (store.state.lease !== null) store.update({ lease: null });
      entered(line);
      return;
    }
    store.update({ battery, waitingToStart, robotOnBoard: { document }, identity: NOTHING_HEARD });
    store.update({ withheld: socket.port?.withheld ?? [] });
    showLease();
    latchAsGateway();
    if (board !== null) showBoard(board);
    else entered({ status: 'identifying' });
    showPlay();
  }

  /** The gateway asks the board who it is: its word counts. */
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
    // Whoever hears of it finds what is known of its slots and servos.
    if (next.status === 'ready' && previous !== 'ready') becomesReady();
    if (next.status !== 'opening') before = null;
    store.update({ link: next });
    if (next.status === previous) return;
    if (previous === 'ready') unlinked(next);
  }

  function becomesReady(): void {
    showSlotsOfBoard();
    if (before !== null) estimate.placed(before);
  }

  /** The board may have moved, restarted or been changed for another before it is ready again. */
  function unlinked(next: LinkState): void {
    estimate.forget(null);
    if (next.status === 'closed') estimate.groupEnded();
    estimate.unstored();
    store.update({ storedSlots: estimate.storedSlots(), ...NOTHING_READ });
    if (next.status === 'lost' || next.status === 'stale')
      latch({ reason: 'reconnected', by: null, stop: 'failed', unheld: estimate.haltPlan(null).unheld });
    else drop();
  }

  /** What was asked for from here and has not left, or is not known to have ended. */
  function drop(): void {
    moves.clear();
    running.forget();
    store.update({ waitingToStart: [], activity: downloadActivity() });
  }

  function showLease(): void {
    const { lease } = driving;
    if (!link.isOpen || lease === null) return;
    const hasLost = store.state.lease?.drives === true && !lease.drives;
    store.update({ lease });
    if (hasLost) drop();
  }

  function latch(next: Latch): void {
    latches += 1;
    store.update({ latch: next });
    drop();
  }

  function latchElsewhere(reason: LatchReason): void {
    latch({ reason, by: stoppedBy, stop: 'sent', unheld: estimate.haltPlan(null).unheld });
  }

  /** Confirmed it stays, whatever is said later. */
  function changeLatch(change: Partial<Pick<Latch, 'stop' | 'unheld'>>): void {
    const { latch: current } = store.state;
    if (current === null) return;
    const stop = current.stop === 'confirmed' ? 'confirmed' : (change.stop ?? current.stop);
    store.update({ latch: { ...current, ...change, stop } });
  }

  function latchChanged(next: LatchReason | null): void {
    const isNews = next !== latchedBy;
    latchedBy = next;
    if (link.isOpen && isNews) {
      if (next === null) store.update({ latch: null });
      else if (store.state.latch === null) latchElsewhere(next);
    }
    if (next === null) socket.settle('released');
  }

  /**
   * Of a link that has opened. What this page moved when it was lost the gateway has stopped, and others may drive since: from here only
   * a STOP is sent that it has not heard. Its failure is the latch's `failed`.
   */
  function latchAsGateway(): void {
    if (unheard !== null) halt(unheard).catch(() => undefined);
    else if (latchedBy !== null) latchElsewhere(latchedBy);
    else if (store.state.latch !== null) store.update({ latch: null });
  }

  async function halt(why: HaltReason): Promise<void> {
    latch({ reason: why, by: null, stop: 'sending', unheld: estimate.haltPlan(null).unheld });
    pressedMs = clock.now();
    unheard = why;
    stopPlaying();
    const halted = sendHalt(why === 'battery' ? 'battery' : 'person');
    stopping = halted.catch(() => undefined);
    await halted;
  }

  async function sendHalt(reason: 'battery' | 'person'): Promise<void> {
    try {
      await socket.answered({ type: 'stop', reason }, 'halted');
      unheard = null;
      changeLatch({ stop: 'sent' });
    } catch (error) {
      if (!(error instanceof LinkError && error.code === 'gatewayUnreachable')) unheard = null;
      changeLatch({ stop: 'failed', unheld: estimate.unheldSince(pressedMs) });
      throw error;
    }
  }

  async function sendPacket(packet: Uint8Array): Promise<void> {
    if (!isHarmlessPacket(packet)) await begin();
    await socket.ask((id) => ({ type: 'packet', id, bytes: compactHex(packet), nonce: driving.nonce }));
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
    if (report.kind === 'runStarted') running.began(report.slot, report.times, 'acknowledged');
    if (report.kind === 'runFinished' || report.kind === 'runStopped') running.ended();
    noteReport(store, report, clock.now());
    if (report.kind === 'runStopped') changeLatch({ stop: 'confirmed' });
  }

  function showPlay(): void {
    if (!link.isOpen) return;
    if (play?.status === 'playing') {
      const { frameIndex, frameCount } = play;
      store.update({ activity: { kind: 'playing', frameIndex, frameCount } });
    } else if (store.state.activity.kind === 'playing') store.update({ activity: IDLE });
  }

  function downloadActivity(): Activity {
    const { download } = slots;
    if (download === null || download.isOver) return IDLE;
    const { isOver: _, ...progress } = download;
    const slot = progress.slots[Math.min(progress.groupsStored, progress.slots.length - 1)] ?? 0;
    return { kind: 'downloading', slot, ...progress };
  }

  function showSlots(): void {
    if (store.state.link.status === 'ready') showSlotsOfBoard();
  }

  function showSlotsOfBoard(): void {
    const { download, broken, versions } = slots;
    if (download !== null) noteDownload(download);
    const brokenSlots = broken.toSorted((a, b) => a - b);
    if (brokenSlots.join() !== store.state.brokenSlots.join()) store.update({ brokenSlots });
    if (versions !== store.state.slotVersions) store.update({ slotVersions: versions });
    showStoredSlots();
    const { kind } = store.state.activity;
    if (kind === 'idle' || kind === 'downloading') store.update({ activity: downloadActivity() });
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

  function refused(id: number, error: LinkError): void {
    if (id === playId) withPlayer((one) => one.refused(id, error));
    else moves.refused(id, error);
  }

  /** What was under way has an unknown outcome. */
  function lost(error: LinkError): void {
    driving.fail(error);
    if (socket.port === null) driving.gone();
    slots.gone(error);
    withPlayer((one) => one.gone(error));
    socket.fail(error);
  }

  /** In the order of what was asked of it. */
  const withPlayer = (tell: (player: GatewayPlayer) => void): void =>
    void player?.then(tell, () => undefined);
  const stopPlaying = (): void => withPlayer((one) => one.stop());

  /** It is tried again when it is asked for again. */
  function notLoaded(error: unknown): never {
    player = null;
    throw error;
  }

  const rest = {
    isMoving: () => estimate.moving(),
    isUnsettled: () => moves.servos().length > 0,
  };

  async function run(slot: number, times: number): Promise<void> {
    requireRunnable(store.state, slot, times);
    running.began(slot, times, 'requested');
    try {
      const outcome = await askDriving((id, nonce) => ({ type: 'run', id, slot, times, nonce }));
      if (outcome === 'acknowledged') running.confirm(outcome);
      if (outcome === 'silent') throw new LinkError('noAnswer', 'the board did not say that it runs it');
    } catch (error) {
      if (error instanceof LinkError && UNCERTAIN.includes(error.code)) running.confirm('unknown');
      else running.ended();
      throw error;
    }
  }

  async function stopGroup(): Promise<void> {
    requireReady(store.state);
    await socket.ask((id) => ({ type: 'stopGroup', id }));
    running.ended();
  }

  async function release(servos: readonly number[]): Promise<void> {
    requireRest(store.state, rest);
    const { family } = store.state;
    releaseCommands(servos, family.servosPerMove, family);
    await askDriving((id, nonce) => ({ type: 'release', id, servos: [...servos], nonce }));
  }

  async function askBattery(): Promise<number> {
    requireLine(store.state);
    await socket.ask((id) => ({ type: 'read', id, what: 'battery', servos: [] }));
    return battery.kind === 'read' ? battery.batteryMv : 0;
  }

  const readBattery = (): Promise<number> =>
    (batteryAsked ??= askBattery().finally(() => (batteryAsked = null)));

  async function read(
    what: 'positions' | 'version' | 'offsets',
    servos: readonly number[] = [],
  ): Promise<void> {
    requireQuestion(store.state);
    await socket.ask((id) => ({ type: 'read', id, what, servos: [...servos] }));
  }

  async function setBoard(next: string): Promise<void> {
    await socket.ask((id) => ({ type: 'board', id, board: next }));
  }

  async function download(groups: readonly SlotGroup[]): Promise<void> {
    requireRest(store.state, rest);
    requireCarried(store.state, 'download');
    for (const command of frameCommands(groups).flat()) encodeOrRefuse(command, store.state.family);
    try {
      await slots.store(groups);
    } finally {
      const { slots: filled, groupsStored } = slots.download ?? { slots: [], groupsStored: 0 };
      const isOurs = filled.join() === groups.map(({ slot }) => slot).join();
      for (const { slot, frames } of isOurs ? groups.slice(0, groupsStored) : [])
        estimate.stored(slot, frames);
      showStoredSlots();
    }
  }

  return {
    get state() {
      return store.state;
    },
    get label() {
      return socket.port?.device ?? '';
    },
    get isSimulated() {
      return socket.port?.simulated ?? false;
    },
    subscribe: store.subscribe,
    open: link.open,
    async close() {
      driving.gone();
      link.close();
      unheard = null;
      store.update({ latch: null });
      await Promise.resolve();
    },
    retryNow: link.retryNow,
    // One tab takes nothing from another: the gateway serves all of them.
    takeOver: link.open,
    leave: () => undefined,
    setAutoReconnect: link.setAutoReconnect,
    async identify() {
      if (!link.isOpen) throw new LinkError('closed', 'the link is not open');
      requireIdle(store.state, rest);
      await setBoard('unknown');
    },
    choose: ({ id }) => setBoard(id),
    lease: (action) =>
      socket.postIfOpen(
        typeof action === 'string' ? { type: 'lease', action } : { type: 'grant', to: action.grantTo },
      ),
    letRun: (forMs) => socket.postIfOpen({ type: 'continue', forMs }),
    calibrate(servo) {
      if (mayDrive) socket.postIfOpen({ type: 'calibrate', servo });
    },
    move(targets, durationMs) {
      requireReleased(store.state);
      for (const target of targets)
        refuseUnfit({ kind: 'move', targets: [target], durationMs }, store.state.family);
      moves.put(targets, durationMs);
    },
    run,
    stopGroup,
    halt: (why = 'pressed') => halt(why),
    async resume() {
      requireReady(store.state);
      const resumed = latches;
      await stopping;
      if (resumed === latches) {
        if (latchedBy === null) socket.post({ type: 'resume' });
        else await socket.answered({ type: 'resume' }, 'released');
      }
      if (resumed !== latches) throw new LinkError('latched', 'stopped again');
      store.update({ latch: null });
    },
    async erase() {
      requireRest(store.state, rest);
      requireCarried(store.state, 'erase');
      refuseUnfit({ kind: 'erase' }, store.state.family);
      store.update({ activity: { kind: 'erasing' } });
      estimate.unstored();
      try {
        await askDriving((id, nonce) => ({ type: 'erase', id, nonce }));
        store.update({ brokenSlots: [] });
      } finally {
        store.update({ storedSlots: estimate.storedSlots(), activity: IDLE });
      }
    },
    readBattery,
    async sendRaw(packet) {
      const { sendRaw } = await import('#shared/robot/raw.ts');
      await sendRaw(packet, store.state, estimate, {
        ...{ run, stop: stopGroup, release, readBattery, send: sendPacket },
      });
    },
    readPositions: (servos) => read('positions', servos),
    readVersion: () => read('version'),
    readOffsets: () => read('offsets'),
    async setSpeed(slot, percent) {
      requireReleased(store.state);
      refuseUnfit({ kind: 'setSpeed', slot, percent }, store.state.family);
      await askDriving((id, nonce) => ({ type: 'setSpeed', id, slot, percent, nonce }));
    },
    release,
    download,
    cancelDownload: slots.cancel,
    async play(frames, { times = 1, loopFrom = 0 } = {}) {
      requireReleased(store.state);
      if (store.state.activity.kind !== 'idle') throw new LinkError('busy', 'something else is running');
      player ??= import('./links/gatewayPlayer.ts').then(({ createGatewayPlayer }) =>
        createGatewayPlayer(socket.postIfOpen, begin, () => (playId = socket.nextId())),
      );
      return (await player.catch(notLoaded)).play(frames, times, loopFrom);
    },
    stopPlaying,
    motions: () => estimate.motions(),
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
