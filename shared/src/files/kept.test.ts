// Files that people have of every version there has been (e2e/kept): each is read, with what stands in it.

import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { describe, expect, test } from 'vitest';
import { robotFromText } from '../profile/robotText.ts';
import { replayText } from '../testing/replay.ts';
import { libraryFromText } from './libraryText.ts';
import { readGroupFile } from './readGroupFile.ts';
import { readRecording } from './recordingText.ts';

const FOLDER = path.resolve(import.meta.dirname, '../../../e2e/kept');
const VERSIONS = readdirSync(FOLDER, { withFileTypes: true }).flatMap((entry) =>
  entry.isDirectory() ? [entry.name] : [],
);

describe.each(VERSIONS)('version %s', (version) => {
  const bytesOf = (name: string): Uint8Array => readFileSync(path.join(FOLDER, version, name));
  const textOf = (name: string): string => new TextDecoder().decode(bytesOf(name));
  const contentOf = (name: string): unknown => JSON.parse(textOf(name));

  test('a group', async () => {
    const read = await readGroupFile(
      { name: 'group.json', bytes: bytesOf('group.json') },
      {
        decode: (bytes) => new TextDecoder().decode(bytes),
        openDatabase: () => Promise.reject(new Error('it is no database')),
      },
    );
    expect(read).toMatchObject({ groups: [(contentOf('group.json') as File).content] });
  });

  test('a library', () => {
    expect(libraryFromText(textOf('library.json'))).toMatchObject({
      value: (contentOf('library.json') as File).content,
    });
  });

  test('a robot', () => {
    expect(robotFromText(textOf('robot.json'))).toMatchObject({
      robot: (contentOf('robot.json') as { robot: object }).robot,
    });
  });

  test('a log, which is replayed', async () => {
    const text = textOf('log.txt');
    const { recording } = readRecording(text);
    expect(recording?.entries.length).toBe(text.match(/^\d+\.\d{3} /gm)?.length);
    expect((await replayText(text)).isGood).toBe(true);
  });
});

interface File {
  readonly content: object;
}
