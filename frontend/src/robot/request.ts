// One request of the gateway's HTTP interface beside the page. Routes, verbs and bodies are typed from the gateway's own description
// (http.generated.ts); an answer's shape is not trusted. Knows no route, and not what a refusal means to the caller.

import * as v from 'valibot';
import type { paths } from './http.generated.ts';

/** How a request says that our own page makes it: a browser adds no Origin to a GET, and no other page may add this header. */
const OWN_PAGE = { 'x-servodeck-page': '1' };

type AnyVerb = 'get' | 'post' | 'put' | 'patch' | 'delete';

export type Path = keyof paths;
/** What may be done at that path. */
export type Verb<P extends Path> = {
  [V in AnyVerb]: paths[P][V] extends { responses: unknown } ? V : never;
}[AnyVerb];

type Frozen<T> = T extends object ? { readonly [K in keyof T]: Frozen<T[K]> } : T;
type Json<T> = T extends { content: { 'application/json': infer Body } } ? Body : never;
type Needs<K extends string, T> = [T] extends [never]
  ? Readonly<Partial<Record<K, never>>>
  : Readonly<Record<K, Frozen<T>>>;
type ValuesIn<Operation> = Operation extends { parameters: { path: infer Values } } ? Values : never;
type QueryOf<Operation> = Operation extends { parameters: { query?: infer Query } } ? Query : never;
type BodyOf<Operation> = Operation extends { requestBody: infer Body } ? Json<Body> : never;

/** What goes with a request: `values` for the names in its path, its body where it takes one. */
export type RequestOptions<P extends Path, V extends Verb<P>> = { readonly withinMs: number } & Needs<
  'values',
  ValuesIn<paths[P][V]>
> &
  Needs<'body', BodyOf<paths[P][V]>> & { readonly query?: Frozen<QueryOf<paths[P][V]>> };

/** What the gateway says that it answers. */
export type Answer<P extends Path, V extends Verb<P>> = paths[P][V] extends { responses: infer Responses }
  ? Json<Responses[keyof Responses]>
  : never;

/** `code` is the gateway's word for why it refuses; null where none has answered, or something else has. */
export class GatewayProblem extends Error {
  override readonly name = 'GatewayProblem';

  constructor(
    readonly code: string | null,
    detail: string,
    /** With `portBusy`: the programs that have the port, where its system reports them. */
    readonly heldBy: readonly string[] = [],
    options?: ErrorOptions,
  ) {
    super(detail, options);
  }
}

/** The static site says in its head that there is none, and no request is sent. Measurements and tests under Node have no document. */
export const isWithoutGateway = (): boolean =>
  typeof document !== 'undefined' &&
  document.querySelector('meta[name="servodeck-gateway"][content="none"]') !== null;

/** The answer, null where it is none. Rejects with a GatewayProblem. */
export async function request<P extends Path, V extends Verb<P>>(
  verb: V,
  path: P,
  requested: RequestOptions<P, V>,
): Promise<unknown> {
  const { withinMs, values = {}, body, query = {} } = requested as Plain;
  if (isWithoutGateway()) throw new GatewayProblem(null, 'this page is served without a gateway');
  const response = await fetch(addressOf(path, values, query), {
    method: verb.toUpperCase(),
    signal: AbortSignal.timeout(withinMs),
    headers: { ...OWN_PAGE, ...(body !== undefined && { 'content-type': 'application/json' }) },
    ...(body !== undefined && { body: JSON.stringify(body) }),
  }).catch((error: unknown) => {
    throw new GatewayProblem(null, 'the gateway does not answer', [], { cause: error });
  });
  const answer: unknown = await response.json().catch(() => null);
  if (response.ok) return answer;
  const { code, detail, heldBy } = isRecord(answer) ? answer : {};
  if (typeof code !== 'string') throw new GatewayProblem(null, 'no gateway is at this address');
  throw new GatewayProblem(
    code,
    typeof detail === 'string' ? detail : '',
    Array.isArray(heldBy) ? heldBy.map(String) : [],
  );
}

interface Plain {
  readonly withinMs: number;
  readonly values?: object;
  readonly body?: unknown;
  readonly query?: object;
}

/** Beside the page, which may be served below a path of its own. */
function addressOf(path: string, values: object, query: object): string {
  const known = new Map(Object.entries(values));
  const address = path
    .slice(1)
    .replace(/\{(\w+)\}/g, (_, name: string) => encodeURIComponent(String(known.get(name))));
  const requested = new URLSearchParams(Object.entries(query).map(([name, value]) => [name, String(value)]));
  return requested.size === 0 ? address : `${address}?${requested.toString()}`;
}

export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

interface RequestsOptions {
  readonly withinMs: number;
  /** The caller's own error for one of the gateway. */
  failed(problem: GatewayProblem, options: ErrorOptions): Error;
  /** The caller's own error for an answer of another shape. */
  unreadable(): Error;
}

type Given<P extends Path, V extends Verb<P>> = Omit<RequestOptions<P, V>, 'withinMs'>;

/** The requests of one part of the page, which has errors of its own. */
export function requestsOf({ withinMs: usualMs, failed, unreadable }: RequestsOptions) {
  function answerTo<P extends Path, V extends Verb<P>>(
    verb: V,
    path: P,
    given: Given<P, V>,
    withinMs = usualMs,
  ): Promise<unknown> {
    return request(verb, path, { ...given, withinMs } as RequestOptions<P, V>).catch((error: unknown) => {
      throw error instanceof GatewayProblem ? failed(error, { cause: error }) : error;
    });
  }

  return {
    async ask<P extends Path, V extends Verb<P>>(
      verb: V,
      path: P,
      schema: v.GenericSchema<unknown, Answer<P, V>>,
      given: Given<P, V>,
      withinMs?: number,
    ): Promise<Answer<P, V>> {
      const read = v.safeParse(schema, await answerTo(verb, path, given, withinMs));
      if (!read.success) throw unreadable();
      return read.output;
    },
    /** For answers that say nothing new. */
    async send<P extends Path, V extends Verb<P>>(verb: V, path: P, given: Given<P, V>): Promise<void> {
      await answerTo(verb, path, given);
    },
  };
}
