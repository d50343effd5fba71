// One request of the gateway's HTTP interface beside the page. Trusts no answer's shape; every failure is a LinkError. Knows no
// route.

import { isLinkErrorCode, LinkError } from '#shared/session/linkError.ts';

/** Rejects where nobody answers in time, and with what the gateway says it refuses for. */
export async function askGateway(path: string, request: RequestInit, withinMs: number): Promise<unknown> {
  const signal = AbortSignal.timeout(withinMs);
  const response = await fetch(path, { ...request, signal }).catch((error: unknown) => {
    throw new LinkError('gatewayUnreachable', 'the gateway does not answer', { cause: error });
  });
  const answer: unknown = await response.json().catch(() => null);
  if (response.ok) return answer;
  throw problem(answer);
}

export function withBody(method: 'PUT' | 'POST', body: object): RequestInit {
  return { method, headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) };
}

export function refusal(code: string, detail: string): LinkError {
  return new LinkError(isLinkErrorCode(code) ? code : 'gatewayRefused', detail);
}

export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function problem(body: unknown): LinkError {
  if (!isRecord(body) || typeof body.code !== 'string') {
    return new LinkError('gatewayUnreachable', 'no gateway is at this address');
  }
  return refusal(body.code, typeof body.detail === 'string' ? body.detail : '');
}
