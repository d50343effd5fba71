// Who may move a shared robot, as this end is told. Knows no transport; who gets the lease is decided where the port is.

import { LinkError } from './linkError.ts';

/** A run that may go on without whoever began it. */
export interface Unattended {
  /** null where the gateway plays. */
  readonly slot: number | null;
  readonly times: number;
  readonly by: string;
  /** At the latest, from when this was told. */
  readonly endsInMs: number;
}

/** Somebody who is here and may drive. */
export interface Candidate {
  readonly id: string;
  readonly name: string;
}

export interface Lease {
  /** What people call this end; its other windows are called so too. */
  readonly you: string;
  /** People's name for whoever drives, null where nobody does: whoever wants to move then gets it by that. */
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
  /** Without asking. */
  readonly mayTake: boolean;
  /** Who handed it to this end, which drives; null where nobody did. */
  readonly grantedBy: string | null;
  /** Whom this end may hand it to. */
  readonly candidates: readonly Candidate[];
  /** Others who look on or drive. */
  readonly others: number;
  /** What runs without its driver; whoever drives next ends it. */
  readonly unattended: Unattended | null;
}

/**
 * `request` it; `release` it, to the client that has requested it if there is one, or withdraw a request; `refuse` a request;
 * `take` it without a request; `grantTo` one of the candidates, by id.
 */
export type LeaseAction = 'request' | 'release' | 'refuse' | 'take' | { readonly grantTo: string };

/** Somebody else drives, or this end never may. On a link of its own there is no lease. */
export function isWatching(lease: Lease | null): boolean {
  return lease !== null && !lease.drives && (lease.driver !== null || !lease.mayDrive);
}

/** Who may resume: while somebody drives they or an owner, otherwise whoever may drive. */
export function mayResume(lease: Lease | null): boolean {
  return lease === null || lease.mayTake || (lease.mayDrive && (lease.drives || lease.driver === null));
}

export function notDriving(lease: Lease | null): LinkError {
  return new LinkError('notDriving', lease?.driver ?? '');
}
