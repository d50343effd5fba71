// Whether something may move or be asked of the board now, judged from one snapshot, with the reason where it may not.
// Pure; the session refuses by itself, this only lets the panels say so beforehand.

import type { SessionState } from '#shared/session/state.ts';

export type Hindrance = 'closed' | 'identifying' | 'stale' | 'latched' | 'busy';

/** null: motion may begin. */
export function motionHindrance({ link, latch, activity }: SessionState): Hindrance | null {
  if (link.status === 'identifying' || link.status === 'stale') return link.status;
  if (link.status !== 'ready') return 'closed';
  if (latch !== null) return 'latched';
  return activity.kind === 'downloading' || activity.kind === 'erasing' ? 'busy' : null;
}
