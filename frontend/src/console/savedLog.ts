// The log as a file: its text, its name, and the browser's way to save it. Knows no panel.

import { family, type BoardId } from '#shared/protocol/families.ts';
import { writeRecording } from '#shared/recording/text.ts';
import type { Entry } from '#shared/recording/recording.ts';
import type { TrafficLog } from '../stores/traffic.ts';
import { version } from '../../../package.json';
import { meaning } from './describe.ts';

export interface SavedLog {
  readonly name: string;
  readonly text: string;
}

/** `board` and `port` of the link at hand. */
export function logFile(log: TrafficLog, board: BoardId, port: string, date: Date): SavedLog {
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

export function saveFile({ name, text }: SavedLog): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  URL.revokeObjectURL(url);
}
