// One request of the gateway's HTTP interface beside the page. Trusts no answer's shape. Knows no route, and not what a refusal
// means to whoever asks.

/** How a request says that our own page makes it: a browser adds no Origin to a GET, and no other page may add this header. */
const OWN_PAGE = { 'x-servodeck-page': '1' };

export type Method = 'GET' | 'POST' | 'PUT' | 'PATCH' | 'DELETE';

export interface Asking {
  readonly method?: Method;
  readonly body?: object | undefined;
  readonly withinMs: number;
}

/** `code` is the gateway's word for why it refuses; null where none has answered, or something else has. */
export class GatewayProblem extends Error {
  override readonly name = 'GatewayProblem';

  constructor(
    readonly code: string | null,
    detail: string,
    options?: ErrorOptions,
  ) {
    super(detail, options);
  }
}

/** The static site says in its head that there is none, and asks nobody. Measurements and tests under Node have no document. */
export const isWithoutGateway = (): boolean =>
  typeof document !== 'undefined' &&
  document.querySelector('meta[name="servodeck-gateway"][content="none"]') !== null;

/** The answer, null where it is none. Rejects with a GatewayProblem. */
export async function request(path: string, { method = 'GET', body, withinMs }: Asking): Promise<unknown> {
  if (isWithoutGateway()) throw new GatewayProblem(null, 'this page is served without a gateway');
  const response = await fetch(path, {
    method,
    signal: AbortSignal.timeout(withinMs),
    headers: { ...OWN_PAGE, ...(body !== undefined && { 'content-type': 'application/json' }) },
    ...(body !== undefined && { body: JSON.stringify(body) }),
  }).catch((error: unknown) => {
    throw new GatewayProblem(null, 'the gateway does not answer', { cause: error });
  });
  const answer: unknown = await response.json().catch(() => null);
  if (response.ok) return answer;
  const { code, detail } = isRecord(answer) ? answer : {};
  if (typeof code !== 'string') throw new GatewayProblem(null, 'no gateway is at this address');
  throw new GatewayProblem(code, typeof detail === 'string' ? detail : '');
}

export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
