// The log as a file: its text and its name. Knows no panel.

import { family, type BoardId } from '#shared/codec/families.ts';
import { writeRecording } from '#shared/files/recordingText.ts';
import type { Entry } from '#shared/files/recording.ts';
import type { TrafficLog } from '../../robot/traffic.ts';
import type { TextFile } from '../../ui/saveFile.ts';
import { version } from '../../../../package.json';
import { meaning } from './describe.ts';

/** `board` and `port` of the link at hand. */
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
