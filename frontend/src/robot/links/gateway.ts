// A board on the gateway's serial port, through its WebSocket. Knows the messages; what may be sent and when is the
// gateway's to decide. The socket stays open while the gateway's port is away, to hear of its return.

import type { Clock } from '#shared/clock.ts';
import type { MotionBefore } from '#shared/motion/before.ts';
import { fromHex } from '#shared/codec/packet.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { Battery } from '#shared/robot/battery.ts';
import type { SharedBoard } from '#shared/robot/identity.ts';
import type { Played } from '#shared/robot/player.ts';
import type {
  Outcome,
  PlayProgress,
  RobotOnBoard,
  SharedLatchReason,
  SharedPlayer,
  Transport,
  TransportEvents,
} from '#shared/robot/transport.ts';
import { refusal } from './gatewayHttp.ts';
import { createGatewayMoves } from './gatewayMoves.ts';
import type { GatewayPlayer } from './gatewayPlayer.ts';
import { createGatewaySlots } from './gatewaySlots.ts';
import {
  batteryTold,
  boardTold,
  compactHex,
  isHarmlessPacket,
  LATCHED_BY,
  motionBefore,
  reportIn,
  portError,
} from './gatewayValues.ts';
import {
  PROTOCOL,
  type BatteryMessage,
  type ClientMessage,
  type GatewayMessage,
  type PlayState,
  type PortState,
  type RobotState,
  type StateMessage,
} from './messages.generated.ts';
import { createTurn } from './lease.ts';

/** As in backend/servodeck/api/websocket.py. */
const OUTDATED_PAGE = 4001;

type SettleDone = { resolve: (outcome: Outcome) => void; reject: (error: LinkError) => void };
type Settle = { resolve: () => void; reject: (error: LinkError) => void };

/** `url` is the gateway's WebSocket, e.g. `ws://127.0.0.1:8300/ws`. Whoever only looks on calibrates nothing. */
export function createGatewayTransport(url: string, clock: Clock, { mayDrive = true } = {}): Transport {
  let socket: WebSocket | null = null;
  let port: PortState | null = null;
  let events: TransportEvents | null = null;
  let latched: SharedLatchReason | null = null;
  let stoppedBy: string | null = null;
  let robot: RobotOnBoard = { document: null };
  let board: SharedBoard | null = null;
  let battery: Battery = { kind: 'unread' };
  let waitingToStart: readonly number[] = [];
  /** Until the link is open: from then on it follows by itself. */
  let before: MotionBefore | null = null;
  let nextId = 1;
  const turn = createTurn(post, clock.now);
  const slots = createGatewaySlots(beginTurn, () => events?.slotsChanged?.());
  const moves = createGatewayMoves({
    ...{ clock, begin: beginTurn, post },
    nextId: () => nextId++,
    failed: (error) => events?.moveFailed?.(error),
  });
  /** Comes when it is first asked for. */
  let player: Promise<GatewayPlayer> | null = null;
  let playId = 0;
  let progress: PlayProgress | null = null;
  const asked = new Map<number, SettleDone>();
  const halting = new Set<Settle>();
  const resuming = new Set<Settle>();
  const stateWaiters = new Set<Settle>();
  let notifyAvailable = (): void => undefined;

  function post(message: ClientMessage): void {
    if (socket?.readyState !== WebSocket.OPEN)
      throw new LinkError('gatewayUnreachable', 'the gateway is gone');
    socket.send(JSON.stringify(message));
  }

  function heard(message: GatewayMessage): void {
    switch (message.type) {
      case 'welcome':
        turn.told(message.lease);
        robotChanged(message.robot);
        before = motionBefore(message.motion);
        slots.told(message.job);
        playTold(message.play);
        batteryChanged(message.battery);
        stateChanged(message);
        break;
      case 'state':
        stateChanged(message);
        break;
      case 'battery':
        batteryChanged(message.battery);
        break;
      case 'robot':
        robotChanged(message.robot);
        break;
      case 'resumed':
        events?.resumed?.(message.by);
        break;
      case 'lease':
        turn.told(message.lease);
        leaseChanged();
        break;
      case 'left':
        for (const command of message.commands) events?.left?.(command);
        break;
      case 'job':
        slots.told(message.job);
        break;
      case 'play':
        playTold(message.play);
        break;
      case 'played':
        tellPlayer((one) => one.ended(message));
        break;
      case 'tick':
        turn.ticked(message.nonce);
        break;
      case 'received':
        events?.heard?.(reportIn(message), fromHex(message.bytes));
        break;
      case 'noise':
        events?.noise?.(message.reason, fromHex(message.bytes));
        break;
      case 'done':
        take(message.id)?.resolve(message.outcome ?? 'sent');
        break;
      case 'refused':
        refused(message.id, refusal(message.code, message.detail));
        break;
      case 'halted':
        events?.halted?.(message.unheld && { ...message.unheld, forMs: message.unheld.forMs ?? Infinity });
        settleAll(halting, (waiter) => waiter.resolve());
        break;
    }
  }

  async function beginTurn(withinMs?: number): Promise<string> {
    await turn.begin(withinMs);
    return turn.nonce ?? '';
  }

  function stateChanged(state: Omit<StateMessage, 'type'>): void {
    slots.toldHeld(state.brokenSlots, state.slotVersions);
    turn.counted(state.clients, state.unattended);
    leaseChanged();
    board = boardTold(state);
    if (board !== null) events?.identified?.(board);
    portChanged(state.port);
    waitingChanged(state.waitingToStart);
    stoppedBy = state.stoppedBy;
    latchChanged(state.latchedBy && LATCHED_BY[state.latchedBy]);
  }

  function waitingChanged(servos: readonly number[]): void {
    if (servos.join() === waitingToStart.join()) return;
    waitingToStart = servos;
    events?.waiting?.(servos);
  }

  function leaseChanged(): void {
    if (turn.lease !== null) events?.leased?.(turn.lease);
  }

  function batteryChanged(told: BatteryMessage['battery']): void {
    battery = batteryTold(told, clock.now());
    events?.battery?.(battery);
  }

  function robotChanged(told: RobotState | null): void {
    robot = { document: told?.id ?? null };
    events?.described?.(robot);
  }

  function playTold(play: PlayState | null): void {
    progress = play?.status === 'playing' ? play : null;
    events?.playing?.(progress);
  }

  /** Without an id it was a stop or a resume. */
  function refused(id: number | null, error: LinkError): void {
    if (id === null) return rejectAll(error);
    const waiter = take(id);
    if (waiter !== undefined) return waiter.reject(error);
    if (id === playId) tellPlayer((one) => one.refused(id, error));
    else moves.refused(id, error);
  }

  function rejectAll(error: LinkError): void {
    for (const waiters of [halting, resuming]) settleAll(waiters, (waiter) => waiter.reject(error));
  }

  function take(id: number): SettleDone | undefined {
    const waiter = asked.get(id);
    asked.delete(id);
    return waiter;
  }

  function ask(message: (id: number) => ClientMessage): Promise<Outcome> {
    return new Promise((resolve, reject) => {
      const id = nextId++;
      post(message(id));
      asked.set(id, { resolve, reject });
    });
  }

  /** Of whoever drives. */
  async function askDriving(message: (id: number, nonce: string) => ClientMessage): Promise<Outcome> {
    const nonce = await beginTurn();
    return ask((id) => message(id, nonce));
  }

  function portChanged(next: PortState): void {
    const wasOpen = port?.status === 'open';
    port = next;
    settleAll(stateWaiters, (waiter) => waiter.resolve());
    events?.withholds?.(next.withheld);
    if (next.status === 'open') notifyAvailable();
    else if (wasOpen) lose(portError(next));
  }

  function latchChanged(next: SharedLatchReason | null): void {
    if (next !== latched) events?.latched?.(next, stoppedBy);
    latched = next;
    if (next === null) settleAll(resuming, (waiter) => waiter.resolve());
  }

  /** Tells the session once; what was under way has an unknown outcome. */
  function lose(error: LinkError): void {
    const told = events;
    events = null;
    turn.fail(error);
    slots.gone(error);
    tellPlayer((one) => one.gone(error));
    for (const waiter of asked.values()) waiter.reject(error);
    asked.clear();
    rejectAll(error);
    told?.lost(error);
  }

  async function connect(): Promise<void> {
    if (socket !== null) return;
    const opening = new WebSocket(`${url}?protocol=${PROTOCOL}`);
    socket = opening;
    latched = null;
    opening.onmessage = ({ data }) => heard(JSON.parse(String(data)) as GatewayMessage);
    opening.onclose = ({ code }) => {
      if (socket !== opening) return;
      socket = null;
      port = null;
      turn.gone();
      const gone = endedBy(code);
      settleAll(stateWaiters, (waiter) => waiter.reject(gone));
      lose(gone);
    };
    await nextState();
  }

  /** What is said to a gateway that is gone need not reach it: it is said again once the link is ready. */
  function postIfOpen(message: ClientMessage): void {
    if (socket?.readyState === WebSocket.OPEN) post(message);
  }

  async function play(...wish: Parameters<SharedPlayer['play']>): Promise<Played> {
    player ??= import('./gatewayPlayer.ts').then(({ createGatewayPlayer }) =>
      createGatewayPlayer(postIfOpen, beginTurn, () => (playId = nextId++)),
    );
    return (await player.catch(notLoaded)).play(...wish);
  }

  /** It is tried again when it is asked for again. */
  function notLoaded(error: unknown): never {
    player = null;
    throw error;
  }

  /** In the order of what was asked of it. */
  const tellPlayer = (tell: (player: GatewayPlayer) => void): void =>
    void player?.then(tell, () => undefined);
  const stopPlaying = (): void => tellPlayer((one) => one.stop());

  function answered(waiters: Set<Settle>, message: ClientMessage): Promise<void> {
    return new Promise((resolve, reject) => {
      post(message);
      waiters.add({ resolve, reject });
    });
  }

  const nextState = (): Promise<void> =>
    new Promise((resolve, reject) => stateWaiters.add({ resolve: () => resolve(), reject }));

  return {
    kind: 'gateway',
    longestPacket: Infinity,
    slots,
    moves,
    player: { play, stop: stopPlaying },
    commands: {
      run: (slot, times) => askDriving((id, nonce) => ({ type: 'run', id, slot, times, nonce })),
      stopGroup: () => ask((id) => ({ type: 'stopGroup', id })),
      erase: () => askDriving((id, nonce) => ({ type: 'erase', id, nonce })),
      setSpeed: (slot, percent) =>
        askDriving((id, nonce) => ({ type: 'setSpeed', id, slot, percent, nonce })),
      read: (what, servos = []) => ask((id) => ({ type: 'read', id, what, servos: [...servos] })),
      release: (servos) => askDriving((id, nonce) => ({ type: 'release', id, servos: [...servos], nonce })),
    },
    get isSimulated() {
      return port?.simulated ?? false;
    },
    async readBattery() {
      await ask((id) => ({ type: 'read', id, what: 'battery', servos: [] }));
      return battery.kind === 'read' ? battery.batteryMv : 0;
    },
    async setBoard(next) {
      await ask((id) => ({ type: 'board', id, board: next }));
    },
    calibrate(servo) {
      if (mayDrive) postIfOpen({ type: 'calibrate', servo });
    },
    get label() {
      return port?.device ?? '';
    },
    async open(next) {
      await connect();
      while (port?.status === 'opening') await nextState();
      if (port?.status !== 'open') throw portError(port);
      events = next;
      if (board !== null) next.identified?.(board);
      next.battery?.(battery);
      next.described?.(robot);
      if (before !== null) next.placed?.(before);
      before = null;
      if (turn.lease !== null) next.leased?.(turn.lease);
      next.withholds?.(port.withheld);
      next.waiting?.(waitingToStart);
      if (latched !== null) next.latched?.(latched, stoppedBy);
      next.playing?.(progress);
    },
    async send(packet) {
      if (!isHarmlessPacket(packet)) await turn.begin();
      await ask((id) => ({ type: 'packet', id, bytes: compactHex(packet), nonce: turn.nonce }));
    },
    lease: (action) =>
      postIfOpen(
        typeof action === 'string' ? { type: 'lease', action } : { type: 'grant', to: action.grantTo },
      ),
    letGoOn: (forMs) => postIfOpen({ type: 'continue', forMs }),
    async halt(why) {
      stopPlaying();
      await answered(halting, { type: 'stop', reason: why === 'battery' ? 'battery' : 'person' });
    },
    async resume() {
      if (latched !== null) await answered(resuming, { type: 'resume' });
      else post({ type: 'resume' });
    },
    whenAvailable(notify) {
      notifyAvailable = notify;
      return () => (notifyAvailable = () => undefined);
    },
    close() {
      events = null;
      turn.gone();
      const closing = socket;
      socket = null;
      port = null;
      closing?.close();
      return Promise.resolve();
    },
  };
}

function endedBy(code: number): LinkError {
  return code === OUTDATED_PAGE
    ? new LinkError('pageOutdated', 'the gateway is of another version')
    : new LinkError('gatewayUnreachable', 'the gateway does not answer');
}

function settleAll(waiters: Set<Settle>, settle: (waiter: Settle) => void): void {
  const current = [...waiters];
  waiters.clear();
  current.forEach(settle);
}
