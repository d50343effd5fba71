// Requests of the gateway beside the page: shared/src/client/request.ts with the header of our own page, a time limit, and schemas that
// check the shape of each answer. Knows no route, and not what a refusal means to the caller.

import * as v from 'valibot';
import {
  GatewayProblem,
  readAnswer,
  request as requestAt,
  type Answer,
  type Given,
  type Path,
  type Verb,
} from '#shared/client/request.ts';

/** Beside the page, which may be served below a path of its own. A browser adds no Origin to a GET, and no other page may add this header. */
const BESIDE = { base: '', headers: { 'x-servodeck-page': '1' } };

export type RequestOptions<P extends Path, V extends Verb<P>> = { readonly withinMs: number } & Given<P, V>;

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
  if (isWithoutGateway()) throw new GatewayProblem(null, 'this page is served without a gateway');
  return requestAt(BESIDE, verb, path, requested, AbortSignal.timeout(requested.withinMs));
}

/** A file of the gateway as text. Rejects with a GatewayProblem. */
export async function requestText(address: string, withinMs: number): Promise<string> {
  const how = { headers: BESIDE.headers, signal: AbortSignal.timeout(withinMs) };
  const response = await fetch(BESIDE.base + address, how).catch((error: unknown) => {
    throw new GatewayProblem(null, 'the gateway does not answer', [], { cause: error });
  });
  if (!response.ok) await readAnswer(response);
  return response.text();
}

interface RequestsOptions {
  readonly withinMs: number;
  /** The caller's own error for one of the gateway. */
  failed(problem: GatewayProblem, options: ErrorOptions): Error;
  /** The caller's own error for an answer of another shape. */
  unreadable(): Error;
}

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
