// The gateway's HTTP interface as far as a page that opens needs it: is there one at its own address, what is on its port, put a robot on
// its board. Trusts no answer's shape; every failure is a LinkError.

import type { Clock } from '#shared/clock.ts';
import { isRecord } from '#shared/client/request.ts';
import { isWithoutGateway } from './request.ts';
import { askGateway } from './links/gatewayValues.ts';

export interface GatewayStatus {
  /** The port in use, null when none is. */
  readonly device: string | null;
  /** The device was declared to be no real board. */
  readonly isSimulated: boolean;
}

export const ANSWER_WITHIN_MS = 2000;
/** It is read from the library first. */
const ROBOT_WITHIN_MS = 4000;
/** For one that has just said who is here: it is only slow, and must not be replaced by another robot for that. */
export const SURE_WITHIN_MS = 10_000;
const PATIENT_MS = 30_000;
const ASK_AGAIN_MS = 1000;
/** Statuses of a server that may be in order a moment later. */
const FROM_HERE_PASSING = 500;

/** null where no gateway answers: the page came from elsewhere, or the gateway is gone. */
export async function readGateway(withinMs = ANSWER_WITHIN_MS): Promise<GatewayStatus | null> {
  try {
    const status: unknown = await askGateway('get', '/api/status', { withinMs });
    if (!isRecord(status) || !isRecord(status.port)) return null;
    const { device, code, simulated } = status.port;
    // Whatever has its name now is one to be chosen like any other.
    return {
      device: typeof device === 'string' && code !== 'otherDevice' ? device : null,
      isSimulated: simulated === true,
    };
  } catch {
    return null;
  }
}

/**
 * Repeats the request until an answer comes: a gateway that is slow is one, a server that answers otherwise has none. Documents must not be stored
 * at two places because of a bad moment.
 */
export async function hasGateway(clock: Clock): Promise<boolean> {
  if (isWithoutGateway()) return false;
  for (;;) {
    const answer = await fetch('api/status', { signal: AbortSignal.timeout(PATIENT_MS) }).catch(() => null);
    if (answer !== null && answer.status < FROM_HERE_PASSING) {
      const status: unknown = await answer.json().catch(() => null);
      // A gateway that requires authentication is one, too.
      return isRecord(status) && (isRecord(status.port) || typeof status.code === 'string');
    }
    await new Promise<void>((resolve) => void clock.after(ASK_AGAIN_MS, resolve));
  }
}

/** The gateway's WebSocket beside the page. */
export function gatewayUrl(): string {
  const url = new URL('ws', document.baseURI);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}

/** Puts a robot of the library on the gateway's board, for everybody. */
export async function putOnBoard(document: string, insteadOf: string | null): Promise<void> {
  const body = { id: document, insteadOf };
  await askGateway('put', '/api/robot', { body, withinMs: ROBOT_WITHIN_MS });
}
