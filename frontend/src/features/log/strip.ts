// Which line of the log the folded strip shows: the newest one, and a stop for as long as nothing may move: what follows a stop
// are its repeats, its holds and the battery. Reads each entry once; knows no page.

import type { Entry } from '#shared/files/recording.ts';
import type { LogEntry, TrafficLog } from '../../robot/traffic.ts';

export interface Strip {
  /** null: the log is empty. */
  latest(): LogEntry | null;
  /** It shows a stop, which must be read at once. */
  isStopped(): boolean;
}

export function createStrip(log: TrafficLog): Strip {
  let readId = 0;
  let shown: LogEntry | null = null;
  let stopped = false;

  function read(): void {
    const { oldestId, nextId } = log.store.getState();
    if (nextId === oldestId) [shown, stopped] = [null, false];
    for (let id = Math.max(readId, oldestId); id < nextId; id++) {
      const newest = log.at(id);
      if (stopped && isPacket(newest.entry)) continue;
      shown = newest;
      stopped = isStop(newest.entry);
    }
    readId = nextId;
  }

  return {
    latest() {
      read();
      return shown;
    },
    isStopped() {
      read();
      return stopped;
    },
  };
}

const isPacket = (entry: Entry): boolean => 'bytes' in entry;

const isStop = (entry: Entry): boolean =>
  entry.mark === 'link' && (entry.happening === 'stopped' || entry.happening === 'latched');
