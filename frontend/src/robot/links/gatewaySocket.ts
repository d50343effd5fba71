// The line to the gateway's board: the WebSocket and the port behind it, messages there and back, requests by number and their
// results. The socket stays open while the port is away, to notice its return. Knows no robot.

import { LinkError } from '#shared/robot/linkError.ts';
import { portError, refusal } from './gatewayValues.ts';
import {
  PROTOCOL,
  type ClientMessage,
  type DoneMessage,
  type GatewayMessage,
  type PortState,
} from '#shared/client/messages.generated.ts';

/** As in backend/servodeck/api/websocket.py. */
const OUTDATED_PAGE = 4001;

export type Outcome = NonNullable<DoneMessage['outcome']>;

/** What answers no single request. */
export type Said = Exclude<GatewayMessage, { type: 'done' | 'refused' }>;

export interface GatewaySocketOptions {
  /** E.g. `ws://127.0.0.1:8300/ws`. */
  readonly url: string;
  heard(message: Said): void;
  /** A run began whose battery could not be judged. */
  batteryUnknown(): void;
  /** Its answer is not awaited. */
  refused(id: number, error: LinkError): void;
  /** The socket has closed by itself, or its port is not open any more. */
  lost(error: LinkError): void;
  /** The port, which was not open, reports why it is not. */
  unavailable(error: LinkError): void;
  /** The port is open again. */
  available(): void;
}

export interface GatewaySocket {
  readonly port: PortState | null;
  /** Resolves when the port is open. */
  open(): Promise<void>;
  close(): void;
  /** Throws `gatewayUnreachable`. */
  post(message: ClientMessage): void;
  /** What is said to a gateway that is gone need not reach it: it is said again once the link is ready. */
  postIfOpen(message: ClientMessage): void;
  nextId(): number;
  /** Resolves when it is done. */
  ask(message: (id: number) => ClientMessage): Promise<Outcome>;
  /** Resolves with the message that answers a stop, or a resume; a refusal without a number rejects both. */
  answered(message: ClientMessage, by: 'halted' | 'released'): Promise<void>;
}

interface Waiter<T> {
  readonly resolve: (value: T) => void;
  readonly reject: (error: LinkError) => void;
}

type Waiters = Set<Waiter<void>>;

export function createGatewaySocket(options: GatewaySocketOptions): GatewaySocket {
  const { url, heard, refused } = options;
  let socket: WebSocket | null = null;
  let port: PortState | null = null;
  let lastId = 0;
  const requested = new Map<number, Waiter<Outcome>>();
  const waiting = { halted: new Set(), released: new Set(), port: new Set() } satisfies Record<
    string,
    Waiters
  >;

  function settle(by: keyof typeof waiting, error?: LinkError): void {
    const current = [...waiting[by]];
    waiting[by].clear();
    for (const { resolve, reject } of current) {
      if (error === undefined) resolve();
      else reject(error);
    }
  }

  function post(message: ClientMessage): void {
    if (socket?.readyState !== WebSocket.OPEN)
      throw new LinkError('gatewayUnreachable', 'the gateway is gone');
    socket.send(JSON.stringify(message));
  }

  function take(id: number): Waiter<Outcome> | undefined {
    const waiter = requested.get(id);
    requested.delete(id);
    return waiter;
  }

  /** Without a number it was a stop or a resume. */
  function refuse(id: number | null, error: LinkError): void {
    if (id === null) for (const by of ['halted', 'released'] as const) settle(by, error);
    else {
      const waiter = take(id);
      if (waiter === undefined) refused(id, error);
      else waiter.reject(error);
    }
  }

  function arrived(message: GatewayMessage): void {
    if (message.type === 'done') done(message);
    else if (message.type === 'refused') refuse(message.id, refusal(message.code, message.detail));
    else said(message);
  }

  function done({ id, outcome, batteryUnknown }: DoneMessage): void {
    if (batteryUnknown) options.batteryUnknown();
    take(id)?.resolve(outcome ?? 'sent');
  }

  function said(message: Said): void {
    const isState = message.type === 'welcome' || message.type === 'state';
    if (isState) portChanged(message.port);
    heard(message);
    if (message.type === 'halted') settle('halted');
    if (isState && message.latchedBy === null) settle('released');
  }

  function portChanged(next: PortState): void {
    const wasOpen = port?.status === 'open';
    port = next;
    settle('port');
    if (next.status === 'open') options.available();
    else if (wasOpen) lost(portError(next));
    else if (next.status !== 'opening') options.unavailable(portError(next));
  }

  /** No answer will come to the request. */
  function lost(error: LinkError): void {
    options.lost(error);
    for (const waiter of requested.values()) waiter.reject(error);
    requested.clear();
    for (const by of ['halted', 'released'] as const) settle(by, error);
  }

  const nextPortState = (): Promise<void> =>
    new Promise((resolve, reject) => waiting.port.add({ resolve, reject }));

  /** Resolves when the gateway has said how its port stands. */
  async function connect(): Promise<void> {
    const opening = new WebSocket(`${url}?protocol=${PROTOCOL}`);
    socket = opening;
    opening.onmessage = ({ data }) => arrived(JSON.parse(String(data)) as GatewayMessage);
    opening.onclose = ({ code }) => {
      if (socket !== opening) return;
      socket = null;
      port = null;
      const error = endedBy(code);
      settle('port', error);
      lost(error);
    };
    await nextPortState();
  }

  return {
    get port() {
      return port;
    },
    async open() {
      if (socket === null) await connect();
      while (port?.status === 'opening') await nextPortState();
      if (port?.status !== 'open') throw portError(port);
    },
    close() {
      const closing = socket;
      socket = null;
      port = null;
      closing?.close();
    },
    post,
    postIfOpen(message) {
      if (socket?.readyState === WebSocket.OPEN) post(message);
    },
    nextId: () => (lastId += 1),
    ask(message) {
      return new Promise((resolve, reject) => {
        const id = (lastId += 1);
        post(message(id));
        requested.set(id, { resolve, reject });
      });
    },
    answered(message, by) {
      return new Promise((resolve, reject) => {
        post(message);
        waiting[by].add({ resolve, reject });
      });
    },
  };
}

function endedBy(code: number): LinkError {
  return code === OUTDATED_PAGE
    ? new LinkError('pageOutdated', 'the gateway is of another version')
    : new LinkError('gatewayUnreachable', 'the gateway does not answer');
}
