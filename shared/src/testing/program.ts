// A saved log in, a report out, as text: what the command line shows. Knows no file and prints nothing.

import { isProfileName } from '../simulator/profileNames.ts';
import { PROFILES } from '../simulator/profiles.ts';
import { replay } from './report.ts';
import { readRecording } from '../files/recordingText.ts';

export interface ProgramResult {
  readonly output: string;
  /** The log could be read, and what it expects came true. */
  readonly isGood: boolean;
}

/** `board` names the simulated board to compare with; without it, the one the log names. */
export async function replayText(text: string, board?: string): Promise<ProgramResult> {
  if (board !== undefined && !isProfileName(board)) {
    const names = Object.keys(PROFILES).join(', ');
    return { output: `No simulated board is called "${board}"; there are ${names}.`, isGood: false };
  }
  const result = readRecording(text);
  if (result.recording === null) {
    const lines = result.problems.map(({ line, reason }) =>
      line === 0 ? reason : `line ${line}: ${reason}`,
    );
    return { output: ['This log cannot be read.', ...lines].join('\n'), isGood: false };
  }
  const report = await replay(result.recording, board);
  return { output: report.text, isGood: report.failed.length === 0 };
}
