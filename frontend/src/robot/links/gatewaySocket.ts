// The WebSocket of the gateway: messages there and back, what was asked by number and how it ended, and the state of the gateway's port.
// The socket stays open while that port is away, to hear of its return. Knows no robot.

import { LinkError } from '#shared/robot/linkError.ts';
import { refusal } from './gatewayHttp.ts';
import {
  PROTOCOL,
  type ClientMessage,
  type DoneMessage,
  type GatewayMessage,
  type PortState,
} from './messages.generated.ts';

/** As in backend/servodeck/api/websocket.py. */
const OUTDATED_PAGE = 4001;

export type Outcome = NonNullable<DoneMessage['outcome']>;

/** What answers no single request. */
export type Said = Exclude<GatewayMessage, { type: 'done' | 'refused' }>;

export interface GatewaySocketOptions {
  /** E.g. `ws://127.0.0.1:8300/ws`. */
  readonly url: string;
  heard(message: Said): void;
  /** Nobody waits for the answer to that one. */
  refused(id: number, error: LinkError): void;
  /** The socket has closed by itself. */
  gone(error: LinkError): void;
}

export interface GatewaySocket {
  readonly port: PortState | null;
  /** Resolves when the gateway has said how its port stands. */
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
  settle(by: 'halted' | 'released'): void;
  /** The port has another state. */
  portChanged(port: PortState): void;
  nextPortState(): Promise<void>;
  /** Whoever waits for an answer waits in vain. */
  fail(error: LinkError): void;
}

interface Waiter<T> {
  readonly resolve: (value: T) => void;
  readonly reject: (error: LinkError) => void;
}

type Waiters = Set<Waiter<void>>;

export function createGatewaySocket({ url, heard, refused, gone }: GatewaySocketOptions): GatewaySocket {
  let socket: WebSocket | null = null;
  let port: PortState | null = null;
  let lastId = 0;
  const asked = new Map<number, Waiter<Outcome>>();
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
    const waiter = asked.get(id);
    asked.delete(id);
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
    if (message.type === 'done') take(message.id)?.resolve(message.outcome ?? 'sent');
    else if (message.type === 'refused') refuse(message.id, refusal(message.code, message.detail));
    else heard(message);
  }

  const nextPortState = (): Promise<void> =>
    new Promise((resolve, reject) => waiting.port.add({ resolve, reject }));

  return {
    get port() {
      return port;
    },
    async open() {
      if (socket !== null) return;
      const opening = new WebSocket(`${url}?protocol=${PROTOCOL}`);
      socket = opening;
      opening.onmessage = ({ data }) => arrived(JSON.parse(String(data)) as GatewayMessage);
      opening.onclose = ({ code }) => {
        if (socket !== opening) return;
        socket = null;
        port = null;
        const error = endedBy(code);
        settle('port', error);
        gone(error);
      };
      await nextPortState();
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
        asked.set(id, { resolve, reject });
      });
    },
    answered(message, by) {
      return new Promise((resolve, reject) => {
        post(message);
        waiting[by].add({ resolve, reject });
      });
    },
    settle,
    portChanged(next) {
      port = next;
      settle('port');
    },
    nextPortState,
    fail(error) {
      for (const waiter of asked.values()) waiter.reject(error);
      asked.clear();
      for (const by of ['halted', 'released'] as const) settle(by, error);
    },
  };
}

function endedBy(code: number): LinkError {
  return code === OUTDATED_PAGE
    ? new LinkError('pageOutdated', 'the gateway is of another version')
    : new LinkError('gatewayUnreachable', 'the gateway does not answer');
}
