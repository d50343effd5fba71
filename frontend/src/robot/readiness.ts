// Whether a motion or a query is allowed now, judged from one snapshot, with the reason where it may not.
// Pure; the session refuses by itself, this only lets the panels say so beforehand.

import { isWatching } from '#shared/robot/lease.ts';
import type { Family } from '#shared/codec/families.ts';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import {
  wasCommanded,
  type Activity,
  type LinkState,
  type ServoMotion,
  type SessionState,
} from '#shared/robot/state.ts';
import type { DeviceState } from './device.ts';

export type Hindrance =
  | 'closed'
  | 'identifying'
  | 'stale'
  | 'latched'
  | 'watching'
  | 'asking'
  | 'viewing'
  | 'busy';

/** Such a board reports the positions of its servos. */
export function tellsPositions({ commands }: Family): boolean {
  return commands.includes('readPositions') || commands.includes('readAllPositions');
}

export type ShownActivity = Activity | { readonly kind: 'moving' };

/** What people are told that the robot does, wherever it is shown: `idle` only where nothing may move, as far as can be known. */
export function shownActivity({
  snapshot,
  isMoving,
}: Pick<DeviceState, 'snapshot' | 'isMoving'>): ShownActivity {
  const { activity } = snapshot;
  return activity.kind === 'idle' && isMoving ? MOVING : activity;
}

const MOVING = { kind: 'moving' } as const;

/** A question moves nothing, so it may go out while stopped; on some boards it would end a running group. */
export function mayAsk({ link, activity }: SessionState, { queryKillsRun }: Family): boolean {
  if (link.status !== 'ready' || activity.kind === 'downloading' || activity.kind === 'erasing') return false;
  return activity.kind !== 'running' || !queryKillsRun;
}

/** Of a line that is open, what the board on it did not say. */
const OF_OPEN_LINES: readonly LinkErrorCode[] = ['boardUnknown', 'wrongBoard', 'echo'];

/** The line is open, whatever the board on it says. */
export function isLineOpen(link: LinkState): boolean {
  if (link.status === 'refused') return OF_OPEN_LINES.includes(link.error.code);
  return link.status === 'identifying' || link.status === 'ready' || link.status === 'stale';
}

/** The link is the board's own USB cable, which is not to carry these: every board on one answers. */
export function isBoardsOwnCable(withheld: SessionState['withheld']): boolean {
  return withheld.includes('download');
}

/** null: motion may begin. */
export function motionHindrance({ link, latch, lease, activity }: SessionState): Hindrance | null {
  if (link.status === 'identifying' || link.status === 'stale') return link.status;
  if (link.status !== 'ready') return 'closed';
  if (latch !== null) return 'latched';
  if (lease?.mayDrive === false) return 'viewing';
  if (isWatching(lease)) return lease?.hasRequested === true ? 'asking' : 'watching';
  return activity.kind === 'downloading' || activity.kind === 'erasing' ? 'busy' : null;
}

/** What only brushes a servo, like the wheel, may move it: never as its first move, and never to begin to drive. */
export function mayBrush(snapshot: SessionState, motion: ServoMotion): boolean {
  const drives = snapshot.lease?.drives ?? true;
  return drives && wasCommanded(motion) && motionHindrance(snapshot) === null;
}

/** What moves the robot by itself ends here for good: it is begun anew by a person. */
export function endsMotion({ link, latch, lease }: SessionState): boolean {
  return link.status !== 'ready' || latch !== null || isWatching(lease);
}

/** null: something that takes its own time may begin, because nothing else is at it. */
export function startHindrance(snapshot: SessionState): Hindrance | null {
  return motionHindrance(snapshot) ?? (snapshot.activity.kind === 'idle' ? null : 'busy');
}
