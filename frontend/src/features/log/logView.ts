// The visible part of the log: the newest entries that pass a filter, and the counts of passed and hidden ones. Reads each entry once, so
// that the length of the log does not matter. React reads it as an external store.

import { family, type BoardId } from '#shared/codec/families.ts';
import { writeRecording } from '#shared/files/recordingText.ts';
import type { Entry } from '#shared/files/recording.ts';
import type { TrafficLog, LogEntry } from '../../robot/traffic.ts';
import type { TextFile } from '../../ui/localFiles.tsx';
import { version } from '../../../../package.json';
import { meaning } from './packetText.ts';

/** The log as a file. `board` and `port`: of the current link. */
export function logFile(log: TrafficLog, board: BoardId, port: string, date: Date): TextFile {
  const content = log.content(board);
  let current = content.board;
  function noteOf(entry: Entry): string {
    if (entry.mark === 'board') current = entry.board;
    return meaning({ board: current, entry });
  }
  const header = { board: content.board, port, date: date.toISOString(), app: version, expectations: [] };
  const day = date.toISOString().slice(0, 16).replaceAll(':', '');
  return {
    name: `servodeck-${family(board).id}-${day}.txt`,
    text: writeRecording({ header, entries: content.entries }, noteOf),
  };
}

interface LogView {
  /** The newest entries that pass, oldest first. */
  readonly shown: readonly LogEntry[];
  readonly passedCount: number;
  readonly hiddenCount: number;
}

interface LogViewStore {
  getSnapshot(): LogView;
  subscribe(listener: () => void): () => void;
}

/** The number of rendered lines. */
const DRAWN = 200;

/** Leaves out entries from `heldId` on: the log is paused there. */
export function createLogView(
  log: TrafficLog,
  passes: (entry: LogEntry) => boolean,
  heldId = Infinity,
): LogViewStore {
  let nextId = 0;
  let passedIds: number[] = [];
  let shown: LogEntry[] = [];
  let snapshot: LogView = { shown, passedCount: 0, hiddenCount: 0 };

  function read(): void {
    const { oldestId, nextId: newestId } = log.store.getState();
    const endId = Math.max(oldestId, Math.min(newestId, heldId));
    for (let id = Math.max(nextId, oldestId); id < endId; id++) {
      const entry = log.at(id);
      if (!passes(entry)) continue;
      passedIds.push(id);
      shown.push(entry);
    }
    nextId = endId;
    const firstStored = passedIds.findIndex((id) => id >= oldestId);
    if (firstStored !== 0) passedIds = firstStored < 0 ? [] : passedIds.slice(firstStored);
    const passedCount = passedIds.length;
    shown = shown.slice(shown.length - Math.min(DRAWN, passedCount));
    snapshot = { shown, passedCount, hiddenCount: endId - oldestId - passedCount };
  }

  read();
  return {
    getSnapshot: () => snapshot,
    subscribe(listener) {
      const update = (): void => {
        read();
        listener();
      };
      // Entries that came after the first reading.
      read();
      return log.store.subscribe(update);
    },
  };
}
