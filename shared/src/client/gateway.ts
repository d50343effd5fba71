// Requests to a gateway as a program makes them: the token, a limit of time, errors, and a second attempt where an answer was lost and a
// repeat is safe; and its events. Knows the shape of requests and answers; not their order, which is in servodeck.ts.

import timings from '../../protocol/timings.json' with { type: 'json' };
import { errorOf, GatewayError, UnreachableError } from './errors.ts';
import type { GatewayMessage, WelcomeMessage } from './messages.generated.ts';
import {
  GatewayProblem,
  isRecord,
  readAnswer,
  request,
  type Answer,
  type Given,
  type Path,
  type Place,
  type Verb,
} from './request.ts';

const GATEWAY_PORT = '8300';
const SILENCE_MS = timings.program.silenceMs;
const FIRST_PAUSE_MS = 250;
const LONGEST_PAUSE_MS = 5000;
const NO_GATEWAY = 'The server at this address is not a Servodeck gateway.';
/** Node's words for a connection that was there. Browsers do not tell. */
const LOST = new Set(['ECONNRESET', 'EPIPE', 'UND_ERR_SOCKET']);

/** Some events were missed during a reconnect; `welcome` with the whole state follows. */
export interface GapMessage {
  type: 'gap';
  after: string;
}
export type Event = GatewayMessage | GapMessage;

export interface CallOptions {
  /** It moves the robot or stores, and its key lets the gateway recognise a repeat. */
  readonly isKeyed?: boolean;
  /** A repeat does no harm. */
  readonly isSafe?: boolean;
  /** How much longer than other requests it may take. */
  readonly moreS?: number;
  /** In seconds of `performance.now()`: the program waits no longer for it. */
  readonly untilS?: number;
  readonly signal?: AbortSignal | undefined;
}

export interface Gateway {
  /** Rejects with a GatewayError, or with the signal's reason. */
  call<P extends Path, V extends Verb<P>>(
    verb: V,
    path: P,
    given: Given<P, V>,
    options?: CallOptions,
  ): Promise<Answer<P, V>>;
  /** The whole state, as the first event has it. */
  welcome(signal?: AbortSignal): Promise<WelcomeMessage>;
  /** Until the signal is aborted. A lost stream is opened again. */
  events(signal: AbortSignal): AsyncGenerator<Event, void>;
}

/** `where` is an http address. Throws a TypeError where it is none. */
export function gatewayAt(where: string, token: string, timeoutS: number): Gateway {
  const place: Place = {
    base: baseOf(where),
    headers: token === '' ? {} : { authorization: `Bearer ${token}` },
  };
  let wasReached = false;

  const timeoutMs = timeoutS * 1000;

  async function attempt<P extends Path, V extends Verb<P>>(
    { verb, path, given }: { verb: V; path: P; given: Given<P, V> },
    at: Place,
    untilMs: number,
    signal: AbortSignal | undefined,
    presence: Presence,
  ): Promise<Answer<P, V>> {
    const leftMs = Math.max(1, untilMs - performance.now());
    const limits = [AbortSignal.timeout(Math.ceil(leftMs)), ...(signal ? [signal] : [])];
    if (leftMs > timeoutMs) limits.push(presence.watch());
    try {
      const answer = await request(at, verb, path, given, AbortSignal.any(limits));
      wasReached = true;
      return answer as Answer<P, V>;
    } catch (error) {
      signal?.throwIfAborted();
      wasReached ||= error instanceof GatewayProblem && (error.code !== null || wasLost(error));
      throw error;
    } finally {
      presence.end();
    }
  }

  async function* stream(lastId: string | null, ended: AbortSignal): AsyncGenerator<[string | null, Event]> {
    const silence = new AbortController();
    const lastEvent = lastId === null ? {} : { 'last-event-id': lastId };
    let timer = setTimeout(() => silence.abort(), timeoutMs);
    try {
      const response = await fetch(`${place.base}api/events`, {
        headers: { ...place.headers, ...lastEvent },
        signal: AbortSignal.any([ended, silence.signal]),
      });
      if (!response.ok) await readAnswer(response);
      if (response.body === null) throw new UnreachableError(NO_GATEWAY);
      for await (const line of linesOf(response.body)) {
        clearTimeout(timer);
        timer = setTimeout(() => silence.abort(), SILENCE_MS);
        if (line.startsWith('id: ')) lastId = line.slice(4);
        else if (line.startsWith('data: ')) yield [lastId, eventIn(line.slice(6))];
      }
    } catch (error) {
      if (error instanceof GatewayProblem) throw errorOf(error);
      if (error instanceof GatewayError) throw error;
      throw new UnreachableError('The event stream was lost.', { cause: error });
    } finally {
      clearTimeout(timer);
      silence.abort();
    }
  }

  return {
    async call(verb, path, given, options = {}) {
      const { isKeyed = false, isSafe = false, moreS = 0, untilS = Infinity, signal } = options;
      const presence = presenceOf(place, timeoutMs / 2);
      let untilMs = Math.min(performance.now() + timeoutMs + moreS * 1000, untilS * 1000);
      const key = isKeyed ? { 'idempotency-key': newKey() } : {};
      const at = { ...place, headers: { ...place.headers, ...key } };
      for (let pauseMs = FIRST_PAUSE_MS; ; pauseMs *= 2) {
        try {
          return await attempt({ verb, path, given }, at, untilMs, signal, presence);
        } catch (error) {
          if (!(error instanceof GatewayProblem)) throw error;
          if (error.code === null) untilMs = Math.min(untilMs, presence.heardMs() + timeoutMs);
          const again =
            error.code === null ? (isKeyed || isSafe) && wasReached : error.code === 'tooMany' && isSafe;
          const waitMs = error.retryAfterMs ?? pauseMs;
          if (!again || performance.now() + waitMs >= untilMs) throw errorOf(error);
          await pause(waitMs, signal);
        }
      }
    },
    async welcome(signal) {
      const ended = signal ?? new AbortController().signal;
      for await (const [, event] of stream(null, ended)) if (event.type === 'welcome') return event;
      throw new UnreachableError(NO_GATEWAY);
    },
    async *events(signal) {
      let lastId: string | null = null;
      let wasOpen = false;
      const isOver = (): boolean => signal.aborted;
      for (let pauseMs = FIRST_PAUSE_MS; !isOver(); pauseMs = Math.min(2 * pauseMs, LONGEST_PAUSE_MS)) {
        try {
          for await (const [id, event] of stream(lastId, signal)) {
            [lastId, wasOpen, pauseMs] = [id, true, FIRST_PAUSE_MS];
            yield event;
          }
        } catch (error) {
          const mayPass = error instanceof UnreachableError || (error as GatewayError).code === 'busy';
          if (!isOver() && !(wasOpen && mayPass)) throw error;
        }
        await pause(pauseMs, signal).catch(() => undefined);
      }
    },
  };
}

/** Whether the gateway is still there while one request takes long. */
interface Presence {
  /** Aborted when the gateway does not answer any more. */
  watch(): AbortSignal;
  end(): void;
  /** When it was there for the last time; at the beginning, now. */
  heardMs(): number;
}

/** Asks each `lookMs`, and allows as long for an answer. */
function presenceOf(place: Place, lookMs: number): Presence {
  let heardMs = performance.now();
  let timer: ReturnType<typeof setTimeout> | undefined;

  async function look(gone: AbortController): Promise<void> {
    const isThere = await request(place, 'get', '/api/status', {}, AbortSignal.timeout(lookMs)).then(
      () => true,
      (error: unknown) => error instanceof GatewayProblem && error.code !== null,
    );
    if (timer === undefined) return;
    if (!isThere) {
      gone.abort();
      return;
    }
    heardMs = performance.now();
    timer = setTimeout(() => void look(gone), lookMs);
  }

  return {
    watch() {
      const gone = new AbortController();
      timer = setTimeout(() => void look(gone), lookMs);
      return gone.signal;
    },
    end() {
      clearTimeout(timer);
      timer = undefined;
    },
    heardMs: () => heardMs,
  };
}

/** Without a port, an http address gets the gateway's usual one. */
function baseOf(where: string): string {
  const url = new URL(where);
  if (url.protocol !== 'http:' && url.protocol !== 'https:')
    throw new TypeError(`${where} is no address of a gateway, for example http://127.0.0.1:8300.`);
  const hasPort = /^https?:\/\/[^/]*:\d+(\/|$)/.test(where);
  if (!hasPort && url.protocol === 'http:') url.port = GATEWAY_PORT;
  return `${url.origin}${url.pathname.replace(/\/$/, '')}/`;
}

/** In a browser only secure pages have more than this. */
function newKey(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) =>
    byte.toString(16).padStart(2, '0'),
  ).join('');
}

function wasLost({ cause }: GatewayProblem): boolean {
  const inner = cause instanceof Error ? cause.cause : undefined;
  return isRecord(inner) && LOST.has(String(inner.code));
}

async function* linesOf(body: ReadableStream<Uint8Array>): AsyncGenerator<string> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let rest = '';
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    const lines = (rest + decoder.decode(part.value, { stream: true })).split('\n');
    rest = lines.pop() ?? '';
    yield* lines;
  }
}

function eventIn(text: string): Event {
  try {
    return JSON.parse(text) as Event;
  } catch (error) {
    throw new UnreachableError(NO_GATEWAY, { cause: error });
  }
}

/** Rejects with the reason of the signal. */
export function pause(forMs: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    signal?.throwIfAborted();
    const abort = (): void => {
      clearTimeout(timer);
      reject(signal?.reason as Error);
    };
    const timer = setTimeout(() => {
      signal?.removeEventListener('abort', abort);
      resolve();
    }, forMs);
    signal?.addEventListener('abort', abort, { once: true });
  });
}
