// Hands a robot's poses to the gateway, for scripts. Knows the one route; not what a pose is made of.

import type { HandedPoses } from '../stores/poses.ts';
import { askGateway, withBody } from '../transports/gatewayHttp.ts';

const ANSWER_WITHIN_MS = 4000;

/** Rejects with a LinkError. */
export async function handOverPoses(handed: HandedPoses): Promise<void> {
  await askGateway('api/poses', withBody('PUT', handed), ANSWER_WITHIN_MS);
}
