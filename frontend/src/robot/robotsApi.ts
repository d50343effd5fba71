// Puts a robot of the library on the gateway's board, for everybody. Knows the one route; not what a robot is.

import { askGateway } from './links/gatewayHttp.ts';

const ANSWER_WITHIN_MS = 4000;

/** Rejects with a LinkError. */
export async function putOnBoard(document: string, insteadOf: string | null): Promise<void> {
  const body = { id: document, insteadOf };
  await askGateway('api/robot', { method: 'PUT', body, withinMs: ANSWER_WITHIN_MS });
}
