// The gateway's HTTP interface for a link: every failure is a LinkError. Knows no route.

import { isLinkErrorCode, LinkError } from '#shared/robot/linkError.ts';
import { GatewayProblem, request, type RequestOptions, type Path, type Verb } from '../request.ts';

/** Rejects where no answer comes in time, and with the gateway's reason where it refuses. */
export async function askGateway<P extends Path, V extends Verb<P>>(
  verb: V,
  path: P,
  requested: RequestOptions<P, V>,
): Promise<unknown> {
  try {
    return await request(verb, path, requested);
  } catch (error) {
    if (!(error instanceof GatewayProblem)) throw error;
    const { code, message, heldBy } = error;
    throw code === null
      ? new LinkError('gatewayUnreachable', message, { cause: error })
      : refusal(code, message, heldBy);
  }
}

export function refusal(code: string, detail: string, heldBy: readonly string[] = []): LinkError {
  return new LinkError(isLinkErrorCode(code) ? code : 'gatewayRefused', detail, { heldBy });
}
