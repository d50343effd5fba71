// What the operations of a robot on its own channel share: the parts they talk through. Knows no operation by itself.

import type { Clock } from '../clock.ts';
import type { Family } from '../codec/families.ts';
import type { RobotEstimate } from './estimate.ts';
import type { Exchange } from './replies.ts';
import type { Queue } from './queue.ts';
import { requireRest } from './rules.ts';
import type { Activity } from './state.ts';
import type { SessionStore } from './store.ts';

export interface Core {
  readonly family: Family;
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly estimate: RobotEstimate;
  readonly queue: Queue;
  readonly exchange: Exchange;
  /** As many as the board takes in one packet and the link carries. */
  readonly servosPerMove: number;
  /** A move or a stop of ours is still to leave. */
  isUnsettled(): boolean;
  /** Ends what moves, without the latch: resolves when its servos are held. */
  endMotion(): Promise<void>;
  /** A group was told to end: stops follow for as long as that is wanted, where the board may have missed these. */
  insistOnEnd(isWanted: () => boolean): Promise<void>;
}

export function setActivity({ store }: Core, activity: Activity): void {
  store.update({ activity });
}

export function requireAtRest({ store, estimate, isUnsettled }: Core): void {
  requireRest(store.state, { isMoving: estimate.moving, isUnsettled });
}
