// Puts a robot of the library on the gateway's board, for everybody. Knows the one route; not what a robot is.

import { askGateway, withBody } from '../transports/gatewayHttp.ts';

const ANSWER_WITHIN_MS = 4000;

/** Rejects with a LinkError. */
export async function putOnBoard(document: string, insteadOf: string | null): Promise<void> {
  await askGateway('api/robot', withBody('PUT', { id: document, insteadOf }), ANSWER_WITHIN_MS);
}
