// Recordings of things that went wrong, each with what must come of it now: `shared/protocol/vectors/recordings/`. A new one
// needs no new test.

import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { partsOf, replay } from './replay.ts';
import { readRecording } from '../files/recordingText.ts';

const folder = join(import.meta.dirname, '../../protocol/vectors/recordings');
const files = readdirSync(folder);

function recordingOf(text: string) {
  const result = readRecording(text);
  if (result.recording === null) throw new Error(JSON.stringify(result.problems));
  return result.recording;
}

const sample = (): string => readFileSync(join(folder, 'lost-acknowledgement.txt'), 'utf8');

test.each(files)('%s comes to what its header expects', async (file) => {
  const recording = recordingOf(readFileSync(join(folder, file), 'utf8'));
  expect(recording.header.expectations).not.toEqual([]);
  expect((await replay(recording)).failed).toEqual([]);
});

describe('a replay', () => {
  test('names each expectation that did not come true', async () => {
    const recording = recordingOf(sample().replace('answers extra 1', 'answers extra 2'));
    const { failed, text } = await replay(recording);
    expect(failed).toEqual(['answers extra 2']);
    expect(text).toContain('FAILED  answers extra 2');
  });

  test('shows what a simulated board would have said otherwise', async () => {
    const { text } = await replay(recordingOf(sample()));
    expect(text).toMatch(/2\.\d{3} {2}extra {6}55 55 02 19/u);
  });

  test('may be held against another board', async () => {
    const { facts } = await replay(recordingOf(sample()), 'openarm-old');
    // It tells no battery, takes a run without a word and ends it without one.
    expect(facts).toContain('answers missing 3');
  });

  test('says so where no such board can be simulated', async () => {
    const { text } = await replay(recordingOf(sample().replace('board: doc', 'board: unknown')));
    expect(text).toContain('no simulated board is called unknown; name one');
  });

  test('judges the last board of a log, whatever came before it', async () => {
    const log =
      'servodeck-log: 1\nboard: doc\n1 > 55 55 02 0F\n1.03 < 55 55 04 0F 4C 1D\n2 = board xarm\n3 = opened';
    const { facts } = await replay(recordingOf(log));
    expect(facts).toContain('session battery unread');
    expect(facts).not.toContain('session battery 7500 mV');
  });

  test('takes the board as another one from where the log says so', () => {
    const log = 'servodeck-log: 1\nboard: unknown\n1 > 55 55 02 0F\n2 = board xarm\n3 > 55 55 02 07';
    expect(partsOf(recordingOf(log))).toEqual([
      { board: 'unknown', entries: [expect.objectContaining({ atMs: 1_000 })] },
      { board: 'xarm', entries: [expect.objectContaining({ atMs: 3_000 })] },
    ]);
  });
});
