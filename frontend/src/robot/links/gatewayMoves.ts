// A page's moves on their way to the gateway, which merges them, keeps the board's pace and starts first moves gently. What changes
// faster than a message is worth is said together. Knows targets and messages; no socket.

import { sleep, type Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { ClientMessage } from './messages.generated.ts';

/** Below the gateway's rate (web/clients.py). What waits here is that much older when the wire is free. */
export const HAND_OVER_MS = 8;

export interface GatewayMoves {
  /** Newest wins per servo. `durationMs` 0: as fast as the link allows. */
  put(targets: readonly ServoTarget[], durationMs: number): void;
  /** With a value that was not handed over yet. */
  servos(): readonly number[];
  /** Of these servos nothing is handed over that was not yet. */
  drop(servos: readonly number[]): void;
  /** What was not handed over is not any more, and nothing is reported of the rest. */
  clear(): void;
  /** That message was refused. */
  refused(id: number, error: LinkError): void;
}

export interface GatewayMovesOptions {
  readonly clock: Clock;
  /** Gives the nonce of this page's lease. */
  begin(): Promise<string>;
  nextId(): number;
  post(message: ClientMessage): void;
  /** Something did not leave. */
  failed(error: LinkError): void;
}

export function createGatewayMoves({
  clock,
  begin,
  nextId,
  post,
  failed,
}: GatewayMovesOptions): GatewayMoves {
  const waiting = new Map<number, { readonly target: ServoTarget; readonly durationMs: number }>();
  let isHandingOver = false;
  let lastId = 0;
  /** The outcome of these and those before is not reported any more. */
  let forgottenId = 0;

  async function handOver(): Promise<void> {
    isHandingOver = true;
    try {
      while (waiting.size > 0) {
        say(await begin());
        await sleep(clock, HAND_OVER_MS);
      }
    } catch (error) {
      waiting.clear();
      failed(error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error }));
    } finally {
      isHandingOver = false;
    }
  }

  /** Those of one time together. */
  function say(nonce: string): void {
    const values = [...waiting.values()];
    waiting.clear();
    for (const durationMs of new Set(values.map((value) => value.durationMs))) {
      const targets = values.filter((value) => value.durationMs === durationMs).map(({ target }) => target);
      lastId = nextId();
      post({ type: 'move', id: lastId, targets, durationMs, nonce });
    }
  }

  function forget(): void {
    forgottenId = lastId;
  }

  return {
    put(targets, durationMs) {
      for (const { servo, position } of targets) {
        waiting.set(servo, { target: { servo, position }, durationMs });
      }
      if (!isHandingOver) void handOver();
    },
    servos: () => [...waiting.keys()],
    drop: (servos) => servos.forEach((servo) => waiting.delete(servo)),
    clear() {
      waiting.clear();
      forget();
    },
    refused(id, error) {
      if (id <= forgottenId) return;
      // One hand's values are refused for one reason: said once.
      forget();
      failed(error);
    },
  };
}
