// Who may move a shared robot, as this end learns it. Knows no transport; who gets the lease is decided where the port is.

import { LinkError } from './linkError.ts';

/** A run that may go on without the client that began it. */
export interface Unattended {
  /** null where the gateway plays. */
  readonly slot: number | null;
  readonly times: number;
  readonly by: string;
  /** At the latest, from when this was said. */
  readonly endsInMs: number;
  /** A move of a program, which ends by itself. */
  readonly isMove: boolean;
}

/** A client that is connected and may drive. */
export interface Candidate {
  readonly id: string;
  readonly name: string;
}

export interface Lease {
  /** What people call this end; its other windows are called so too. */
  readonly you: string;
  /** People's name for the driver; null where there is none: the first who moves gets it. */
  readonly driver: string | null;
  /** That is this end. */
  readonly drives: boolean;
  /** Name of the client that has requested it from the driver. */
  readonly requestedBy: string | null;
  /** That is this end. */
  readonly hasRequested: boolean;
  /** Until then the driver may refuse the request; from when this arrived. */
  readonly grantedInMs: number | null;
  readonly mayDrive: boolean;
  /** Without a request. */
  readonly mayTake: boolean;
  /** Who granted it to this end, which drives; null where it was not granted. */
  readonly grantedBy: string | null;
  /** Whom this end may hand it to. */
  readonly candidates: readonly Candidate[];
  /** Others who look on or drive. */
  readonly others: number;
  /** What runs without its driver; the next driver ends it. */
  readonly unattended: Unattended | null;
}

/**
 * `request` it; `release` it, to the client that has requested it if there is one, or withdraw a request; `refuse` a request;
 * `take` it without a request; `grantTo` one of the candidates, by id.
 */
export type LeaseAction = 'request' | 'release' | 'refuse' | 'take' | { readonly grantTo: string };

/** Another client drives, or this end never may. On a link of its own there is no lease. */
export function isWatching(lease: Lease | null): boolean {
  return lease !== null && !lease.drives && (lease.driver !== null || !lease.mayDrive);
}

/** Who may resume: the driver or an owner; where there is no driver, everyone who may drive. */
export function mayResume(lease: Lease | null): boolean {
  return lease === null || lease.mayTake || (lease.mayDrive && (lease.drives || lease.driver === null));
}

export function notDriving(lease: Lease | null): LinkError {
  return new LinkError('notDriving', lease?.driver ?? '');
}
