// One request of a gateway's HTTP interface, for the page and for programs. Routes, verbs, bodies and answers are typed from the
// gateway's own description (http.generated.ts). Knows no route, no token, and not what a refusal means to the caller.

import type { paths, Problem } from './http.generated.ts';

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
type BodyOf<Operation> = Operation extends { requestBody?: infer Body } ? Json<Body> : never;

/** What goes with a request: `values` for the names in its path, its body where it takes one. */
export type Given<P extends Path, V extends Verb<P>> = Needs<'values', ValuesIn<paths[P][V]>> &
  Needs<'body', BodyOf<paths[P][V]>> & { readonly query?: Frozen<QueryOf<paths[P][V]>> };

/** What the gateway says that it answers. */
export type Answer<P extends Path, V extends Verb<P>> = paths[P][V] extends { responses: infer Responses }
  ? Json<Responses[keyof Responses]>
  : never;

/** `code` is the gateway's word for why it refuses; null where none has answered, or something else has. */
export class GatewayProblem extends Error {
  override readonly name: string = 'GatewayProblem';

  constructor(
    readonly code: Problem['code'] | (string & {}) | null,
    detail: string,
    /** With `portBusy`: the programs that have the port, where its system reports them. */
    readonly heldBy: readonly string[] = [],
    options?: ErrorOptions,
    /** With `tooMany`: when one more request is taken. */
    readonly retryAfterMs: number | null = null,
  ) {
    super(detail, options);
  }
}

/** Where the gateway is: what stands before `api/…`, empty for a page that it serves; and what every request carries. */
export interface Place {
  readonly base: string;
  readonly headers: Readonly<Record<string, string>>;
}

/** The answer, null where it is none; its shape is not checked. Rejects with a GatewayProblem. */
export async function request<P extends Path, V extends Verb<P>>(
  place: Place,
  verb: V,
  path: P,
  given: Given<P, V>,
  signal: AbortSignal,
): Promise<unknown> {
  const { values = {}, body, query = {} } = given as Plain;
  const response = await fetch(place.base + addressOf(path, values, query), {
    method: verb.toUpperCase(),
    signal,
    headers: { ...place.headers, ...(body !== undefined && { 'content-type': 'application/json' }) },
    ...(body !== undefined && { body: JSON.stringify(body) }),
  }).catch((error: unknown) => {
    throw new GatewayProblem(null, 'the gateway does not answer', [], { cause: error });
  });
  const answer = await readAnswer(response);
  // Its head came in time, its body did not.
  if (answer === null && signal.aborted)
    throw new GatewayProblem(null, 'the gateway does not answer', [], { cause: signal.reason });
  return answer;
}

/** What it holds. Rejects with a GatewayProblem where it is a refusal. */
export async function readAnswer(response: Response): Promise<unknown> {
  const answer: unknown = await response.json().catch(() => null);
  if (response.ok) return answer;
  const { code, detail, heldBy } = isRecord(answer) ? answer : {};
  if (typeof code !== 'string') throw new GatewayProblem(null, 'no gateway is at this address');
  const retryAfter = response.headers.get('retry-after');
  throw new GatewayProblem(
    code,
    typeof detail === 'string' ? detail : '',
    Array.isArray(heldBy) ? heldBy.map(String) : [],
    undefined,
    retryAfter === null ? null : Number(retryAfter) * 1000,
  );
}

interface Plain {
  readonly values?: object;
  readonly body?: unknown;
  readonly query?: object;
}

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
