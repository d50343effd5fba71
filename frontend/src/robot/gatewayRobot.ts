// A robot at the gateway: intents become messages. Holds no queue: the gateway decides what may be done, and when. An intent
// that its last snapshot forbids is not sent. Its answers are read by links/gatewaySnapshot.ts.

import type { Clock } from '#shared/clock.ts';
import { createLink } from '#shared/robot/link.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import type { Robot, RunOptions } from '#shared/robot/robot.ts';
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
import type { HaltReason, SlotGroup } from '#shared/robot/state.ts';
import { createGatewayMoves, createDriving } from './links/driving.ts';
import type { GatewayPlayer } from './links/gatewayPlayer.ts';
import { createGatewaySlots } from './links/gatewaySlots.ts';
import { createGatewaySnapshot } from './links/gatewaySnapshot.ts';
import { createGatewaySocket, type Outcome, type Said } from './links/gatewaySocket.ts';
import { compactHex, isHarmlessPacket } from './links/gatewayValues.ts';
import type { ClientMessage, PlayState } from '#shared/client/messages.generated.ts';

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

/** Whether the board has heard of a run is unknown then. */
const UNCERTAIN: readonly LinkErrorCode[] = ['noAnswer', 'lost', 'gatewayUnreachable'];

export function createGatewayRobot({ url, clock, mayDrive = true }: GatewayRobotOptions): GatewayRobot {
  /** Why STOP was pressed here, where the gateway was not there to hear it. */
  let unheard: HaltReason | null = null;
  let batteryAsked: Promise<number> | null = null;
  /** Loaded when it is first needed. */
  let player: Promise<GatewayPlayer> | null = null;
  let playId = 0;
  let unjudgedPlay = '';

  const socket = createGatewaySocket({
    ...{ url, heard, refused, lost },
    batteryUnknown: () => store.emit('batteryUnknown', undefined),
    unavailable: (error) => link.lost(error),
    available: () => link.available(),
  });
  const driving = createDriving(socket.post, clock.now);
  const slots = createGatewaySlots(begin, () => snapshot.slotsChanged());
  const snapshot = createGatewaySnapshot({
    ...{ clock, driving, slots, sendUnheardStop },
    dropMoves: () => moves.clear(),
  });
  const { store, runs, latch } = snapshot;
  const link = createLink({ clock, open: socket.open, close: socket.close, changed: snapshot.lineChanged });
  const moves = createGatewayMoves({
    ...{ clock, begin, post: socket.post, nextId: socket.nextId },
    failed: (error) => store.emit('problem', error),
  });

  /** Of the page's lease, for requests from now on. */
  async function begin(withinMs?: number): Promise<string> {
    await driving.begin(withinMs);
    return driving.nonce ?? '';
  }

  async function askDriving(message: (id: number, nonce: string) => ClientMessage): Promise<Outcome> {
    const nonce = await begin();
    return socket.ask((id) => message(id, nonce));
  }

  function heard(message: Said): void {
    if (message.type === 'tick') driving.ticked(message.nonce);
    else if (message.type === 'played') withPlayer((one) => one.ended(message));
    else {
      if (message.type === 'play') noteBattery(message.play);
      snapshot.heard(message);
    }
  }

  /** Once for each play, whoever began it. */
  function noteBattery({ id, batteryUnknown }: PlayState): void {
    if (batteryUnknown && id !== unjudgedPlay) store.emit('batteryUnknown', undefined);
    if (batteryUnknown) unjudgedPlay = id;
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
    link.lost(error);
  }

  /** In the order of the requests. */
  const withPlayer = (tell: (player: GatewayPlayer) => void): void =>
    void player?.then(tell, () => undefined);
  const stopPlaying = (): void => withPlayer((one) => one.stop());

  /** It is tried again with the next request. */
  function notLoaded(error: unknown): never {
    player = null;
    throw error;
  }

  const rest = {
    isMoving: snapshot.isMoving,
    isUnsettled: () => moves.servos().length > 0,
  };

  async function run(slot: number, times: number, { anyway = false }: RunOptions = {}): Promise<void> {
    requireRunnable(store.state, slot, times);
    runs.began(slot, times);
    try {
      const outcome = await askDriving((id, nonce) => ({ type: 'run', id, slot, times, nonce, anyway }));
      if (outcome === 'silent') throw new LinkError('noAnswer', 'the board did not say that it runs it');
      runs.settled(outcome === 'acknowledged' ? outcome : 'requested');
    } catch (error) {
      if (error instanceof LinkError && UNCERTAIN.includes(error.code)) runs.settled('unknown');
      else runs.refused();
      throw error;
    }
  }

  async function stopGroup(): Promise<void> {
    requireReady(store.state);
    await socket.ask((id) => ({ type: 'stopGroup', id }));
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
    const { battery } = store.state;
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
        snapshot.stored(slot, frames);
    }
  }

  /** False where the gateway has heard each STOP of this page. */
  function sendUnheardStop(): boolean {
    if (unheard === null) return false;
    // Its failure is the latch's `failed`.
    halt(unheard).catch(() => undefined);
    return true;
  }

  async function halt(why: HaltReason): Promise<void> {
    const { unheld } = snapshot.estimate.haltPlan(null);
    latch.set({ reason: why, by: null, stop: 'sending', unheld });
    latch.press();
    unheard = why;
    stopPlaying();
    await latch.follow(sendHalt(why === 'battery' ? 'battery' : 'person'));
  }

  async function sendHalt(reason: 'battery' | 'person'): Promise<undefined> {
    try {
      await socket.answered({ type: 'stop', reason }, 'halted');
      unheard = null;
    } catch (error) {
      if (!(error instanceof LinkError && error.code === 'gatewayUnreachable')) unheard = null;
      throw error;
    }
  }

  async function sendPacket(packet: Uint8Array): Promise<void> {
    if (!isHarmlessPacket(packet)) await begin();
    await socket.ask((id) => ({ type: 'packet', id, bytes: compactHex(packet), nonce: driving.nonce }));
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
      await link.close();
      unheard = null;
      latch.clear();
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
    limitsChanged: () => undefined,
    refuseRunsBelow: () => undefined,
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
    resume: () =>
      latch.release(async () => {
        if (snapshot.latchedBy === null) socket.post({ type: 'resume' });
        else await socket.answered({ type: 'resume' }, 'released');
      }),
    async erase() {
      requireRest(store.state, rest);
      requireCarried(store.state, 'erase');
      refuseUnfit({ kind: 'erase' }, store.state.family);
      snapshot.erasing(true);
      snapshot.estimate.unstored();
      try {
        await askDriving((id, nonce) => ({ type: 'erase', id, nonce }));
        store.update({ brokenSlots: [] });
      } finally {
        store.update({ storedSlots: snapshot.estimate.storedSlots() });
        snapshot.erasing(false);
      }
    },
    readBattery,
    async sendRaw(packet) {
      const { sendRaw } = await import('#shared/robot/raw.ts');
      await sendRaw(packet, store.state, snapshot.estimate, {
        ...{ run, stop: stopGroup, release, readBattery, send: sendPacket, overtake: moves.drop },
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
    async play(frames, how = {}) {
      requireReleased(store.state);
      if (store.state.activity.kind !== 'idle') throw new LinkError('busy', 'something else is running');
      player ??= import('./links/gatewayPlayer.ts').then(({ createGatewayPlayer }) =>
        createGatewayPlayer(socket.postIfOpen, begin, () => (playId = socket.nextId())),
      );
      return (await player.catch(notLoaded)).play(frames, how);
    },
    stopPlaying,
    motions: () => snapshot.estimate.motions(),
    isMoving: snapshot.isMoving,
  };
}
