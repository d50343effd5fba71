// A gateway for tests of the robot at it: a WebSocket that a test speaks through. A client that requests to drive gets the lease; any other answer is
// the test's. Both directions take `delayMs`.

import { vi } from 'vitest';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import { createGatewayRobot, type GatewayRobot } from './gatewayRobot.ts';
import type {
  ClientMessage,
  GatewayMessage,
  LeaseState,
  StateMessage,
  WelcomeMessage,
} from '#shared/client/messages.generated.ts';

export const FREE: LeaseState = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [] },
};
export const OURS: LeaseState = { ...FREE, driver: 'Ben', drives: true };
export const THEIRS: LeaseState = { ...FREE, driver: 'Bert' };

export const READY: Omit<StateMessage, 'type'> = {
  board: 'doc',
  port: {
    device: '/dev/board',
    status: 'open',
    simulated: false,
    withheld: [],
    code: null,
    detail: null,
    heldBy: [],
    retryInMs: null,
  },
  link: { status: 'ready', code: null, detail: null },
  identity: { evidence: [], candidates: [] },
  ...{ latch: false, latchedBy: null, stoppedBy: null, clients: 1, unattended: null },
  ...{ brokenSlots: [], slotVersions: {}, waitingToStart: [], mayBeRunning: false },
};

const WELCOME: WelcomeMessage = {
  ...READY,
  ...{ type: 'welcome', version: 'test', robot: null, lease: FREE, job: null, play: null },
  motion: { servos: [], runSlot: null, released: [], reported: [] },
  activity: { running: null, mayMove: false },
  battery: { kind: 'unread' },
};

export interface GatewayOptions {
  readonly clock?: VirtualClock;
  readonly delayMs?: number;
  readonly welcome?: Partial<WelcomeMessage>;
  /** What the gateway does with a message besides giving the lease. */
  arrived?(message: ClientMessage): void;
}

export interface GatewayUnderTest {
  readonly clock: VirtualClock;
  readonly robot: GatewayRobot;
  /** All that has arrived but heartbeats and requests of the lease. */
  readonly posted: readonly ClientMessage[];
  say(...messages: readonly GatewayMessage[]): void;
  /** The present state, from now on with these changes. */
  state(changes: Partial<StateMessage>): void;
  /** The newest message with a number is done, or refused. */
  done(outcome?: 'acknowledged' | 'silent' | 'sent'): void;
  refuse(code: 'latched' | 'notDriving' | 'outOfRange', detail?: string): void;
  /** The connection is cut; the next one is welcomed as before. */
  cut(): void;
}

/** Open, unless its port is not. */
export async function createGateway(options: GatewayOptions = {}): Promise<GatewayUnderTest> {
  const { clock = createVirtualClock(), delayMs = 0, arrived = () => undefined } = options;
  const posted: ClientMessage[] = [];
  let state = { ...WELCOME, ...options.welcome };
  let current: FakeSocket | null = null;
  let ticks = 0;

  function later(run: () => void): void {
    if (delayMs === 0) run();
    else clock.after(delayMs, run);
  }

  class FakeSocket {
    static readonly OPEN = 1;
    readyState = 0;
    onmessage: ((event: { data: string }) => void) | null = null;
    onclose: ((event: { code: number }) => void) | null = null;

    constructor() {
      void Promise.resolve(this).then((opened) => {
        opened.readyState = 1;
        current = opened;
        say(state);
      });
    }

    send(text: string): void {
      const message = JSON.parse(text) as ClientMessage;
      later(() => took(message));
    }

    close(): void {
      this.readyState = 3;
      if (current === this) current = null;
    }
  }

  function say(...messages: readonly GatewayMessage[]): void {
    const socket = current;
    for (const message of messages)
      later(() => socket?.readyState === 1 && socket.onmessage?.({ data: JSON.stringify(message) }));
  }

  function tick(): void {
    say({ type: 'tick', nonce: `1-${(ticks += 1)}` });
    clock.after(250, () => current !== null && tick());
  }

  function took(message: ClientMessage): void {
    if (message.type === 'heartbeat') return;
    if (message.type === 'lease' && message.action === 'request') {
      // No answer comes before the question has been sent.
      void Promise.resolve().then(() => {
        say({ type: 'lease', lease: OURS });
        if (ticks === 0) tick();
      });
      return;
    }
    posted.push(message);
    void Promise.resolve().then(() => arrived(message));
  }

  function newestId(): number {
    const numbered = posted.findLast((message) => 'id' in message);
    return numbered !== undefined && 'id' in numbered ? numbered.id : 0;
  }

  vi.stubGlobal('WebSocket', FakeSocket);
  const robot = createGatewayRobot({ url: 'ws://gateway/ws', clock });
  await Promise.all([robot.open().catch(() => undefined), clock.advance(2 * delayMs)]);
  return {
    ...{ clock, robot, posted, say },
    state(changes) {
      state = { ...state, ...changes, type: 'welcome' };
      const {
        lease: _lease,
        job: _job,
        play: _play,
        motion: _motion,
        activity: _activity,
        battery: _battery,
        ...rest
      } = state;
      say({ ...rest, type: 'state' });
    },
    done: (outcome = 'sent') => say({ type: 'done', id: newestId(), outcome, batteryUnknown: false }),
    refuse: (code, detail = '') => say({ type: 'refused', id: newestId(), code, detail }),
    cut() {
      const closing = current;
      current = null;
      ticks = 0;
      if (closing !== null) closing.readyState = 3;
      closing?.onclose?.({ code: 1006 });
    },
  };
}
