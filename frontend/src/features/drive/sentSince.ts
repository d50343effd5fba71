// Counts packets in the log, newest first, so that a long visit costs nothing. Knows no screen.

import type { TrafficLog } from '../../robot/traffic.ts';

export function sentSince({ store, at }: Pick<TrafficLog, 'store' | 'at'>, sinceMs: number): number {
  const { oldestId, nextId } = store.getState();
  let sent = 0;
  for (let id = nextId - 1; id >= oldestId; id -= 1) {
    const { entry } = at(id);
    if (entry.atMs < sinceMs) break;
    if (entry.mark === 'sent') sent += 1;
  }
  return sent;
}
