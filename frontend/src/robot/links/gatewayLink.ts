// The way to the gateway's board through its whole life: opening, open, lost and back again. Lost is the socket, or the port behind it.
// Knows the state of both; no robot.

import type { Clock } from '#shared/clock.ts';
import type { LineState } from '#shared/robot/link.ts';
import { asLinkError, passesByItself, type LinkError } from '#shared/robot/linkError.ts';
import { createReconnect } from '#shared/robot/reconnect.ts';
import type { GatewaySocket } from './gatewaySocket.ts';
import { portError } from './gatewayValues.ts';
import type { PortState } from './messages.generated.ts';

export interface GatewayLinkOptions {
  readonly clock: Clock;
  readonly socket: Pick<GatewaySocket, 'port' | 'open' | 'close' | 'portChanged' | 'nextPortState'>;
  changed(state: LineState): void;
  /** What was under way has an unknown outcome. */
  lost(error: LinkError): void;
}

export interface GatewayLink {
  readonly isOpen: boolean;
  open(): Promise<void>;
  close(): void;
  retryNow(): void;
  setAutoReconnect(enabled: boolean): void;
  portChanged(port: PortState): void;
  socketGone(error: LinkError): void;
}

export function createGatewayLink({ clock, socket, changed, lost }: GatewayLinkOptions): GatewayLink {
  let state: LineState = { status: 'closed' };
  let wasOpenBefore = false;
  /** Counts attempts, so that a late end of an old one is not taken for the new one's. */
  let attempt = 0;
  let mayBeBack = (): void => undefined;

  const isDown = (): boolean => state.status === 'lost' || state.status === 'refused';

  const reconnect = createReconnect({
    clock,
    attempt: retry,
    watch(notify) {
      mayBeBack = notify;
      return () => (mayBeBack = () => undefined);
    },
    planned(retryAtMs) {
      if (state.status === 'lost') enter({ ...state, retryAtMs });
    },
  });

  function enter(next: LineState): void {
    state = next;
    changed(next);
  }

  function fail(error: LinkError): void {
    const passes = passesByItself(error);
    const retryAtMs = reconnect.plan(passes);
    enter(passes ? { status: 'lost', error, retryAtMs } : { status: 'refused', error });
  }

  function retry(): void {
    reconnect.rest();
    // The failure is in the state; there is no caller to tell.
    connect().catch(() => undefined);
  }

  async function openPort(): Promise<void> {
    await socket.open();
    while (socket.port?.status === 'opening') await socket.nextPortState();
    if (socket.port?.status !== 'open') throw portError(socket.port);
  }

  async function connect(): Promise<void> {
    const mine = (attempt += 1);
    if (!isDown()) enter({ status: 'opening' });
    try {
      await openPort();
    } catch (error) {
      const reason = asLinkError(error);
      if (mine === attempt) fail(reason);
      throw reason;
    }
    if (mine !== attempt) return;
    reconnect.refresh();
    const isReturn = wasOpenBefore;
    wasOpenBefore = true;
    enter({ status: 'open', isReturn });
  }

  function went(error: LinkError): void {
    lost(error);
    if (state.status === 'open') fail(error);
  }

  return {
    get isOpen() {
      return state.status === 'open';
    },
    open() {
      reconnect.rest();
      reconnect.refresh();
      return connect();
    },
    close() {
      reconnect.rest();
      attempt += 1;
      wasOpenBefore = false;
      if (state.status !== 'closed') enter({ status: 'closed' });
      socket.close();
    },
    retryNow() {
      if (isDown()) retry();
    },
    setAutoReconnect: reconnect.setEnabled,
    portChanged(next) {
      const wasOpen = socket.port?.status === 'open';
      socket.portChanged(next);
      if (next.status === 'open') mayBeBack();
      else if (wasOpen) went(portError(next));
    },
    socketGone: went,
  };
}
