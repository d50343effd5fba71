// Files of every format mean what their twins say; broken ones say where and why; nothing that anybody may choose makes a
// reader throw, hang or hand out a group that is none.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import fc from 'fast-check';
import { safeParse } from 'valibot';
import { describe, expect, test } from 'vitest';
import { flawOfGroup, groupSchema } from '../group/group.ts';
import { meaningOf, MEANINGS } from '../testing/groups.ts';
import { MAX_FILE_BYTES, readGroupFile, type GroupFile, type Means } from './readGroupFile.ts';
import type { Problem } from './reading.ts';

const folder = join(import.meta.dirname, '../../protocol/vectors/files');
const bytesIn = (name: string): Uint8Array => new Uint8Array(readFileSync(join(folder, name)));
const textFile = (name: string, text: string): GroupFile => ({ name, bytes: new TextEncoder().encode(text) });

/** Without databases: those are the page's. */
const PLAIN_MEANS: Means = {
  decode(bytes, encoding) {
    try {
      return new TextDecoder(encoding, { fatal: true }).decode(bytes);
    } catch {
      return null;
    }
  },
  openDatabase: () => Promise.reject(new Error('no database')),
};

const PLAIN = MEANINGS.filter(({ file }) => !file.endsWith('.d6a'));
const read = (file: GroupFile) => readGroupFile(file, PLAIN_MEANS);

test.each(PLAIN)('$file means what its twin says', async ({ file, called = file, ...meaning }) => {
  expect(meaningOf(await read({ name: called, bytes: bytesIn(file) }))).toEqual([meaning]);
});

test('our own file comes back whole', async () => {
  const reading = await read({ name: 'own.json', bytes: bytesIn('own.json') });
  expect(reading).toMatchObject({
    groups: [{ robot: 'Desk arm', tags: ['hello'], times: 3, markers: [{ text: 'beat' }], nextId: 4 }],
  });
});

const xml = (...rows: string[]): string => `<NewDataSet>\n<Table>\n${rows.join('\n')}\n</Table></NewDataSet>`;
const row = (move: string, time = 'T500'): string => `<ID>1</ID>\n<Move>${move}</Move>\n<Time>${time}</Time>`;
const csv = (...lines: string[]): string => ['Index,Time,Servo1,Servo2', ...lines].join('\n');

describe('a broken file says where and why', () => {
  const BROKEN: readonly (readonly [name: string, text: string, problem: Partial<Problem>])[] = [
    ['a.xml', '', { code: 'empty' }],
    ['a.txt', 'hello', { code: 'unknownFormat' }],
    ['a.xml', 'hello', { code: 'noFrames' }],
    [
      'a.xml',
      xml(row('#1 P1500'), row('#2 P15x0')),
      { code: 'badPosition', place: { line: 7 }, found: '15x0' },
    ],
    ['a.xml', xml(row('#1 P1500 #2 1500')), { code: 'badMove', place: { line: 4 }, found: '#2 1500' }],
    ['a.xml', xml(row('1 P1500')), { code: 'badMove', place: { line: 4 } }],
    ['a.xml', xml(row('#300 P1500')), { code: 'badServo', place: { line: 4 }, found: '300' }],
    ['a.xml', xml(row('#1 P70000')), { code: 'badPosition', place: { line: 4 }, found: '70000' }],
    ['a.xml', xml(row('#1 P1500', 'T1.5')), { code: 'badTime', place: { line: 5 }, found: '1.5' }],
    ['a.xml', xml(row('#1 P1500', 'T-5')), { code: 'badTime', place: { line: 5 }, found: '-5' }],
    ['a.xml', xml(row('#1 P1500', 'T65536')), { code: 'badTime', place: { line: 5 } }],
    [
      'a.xml',
      xml(row('#1 P1500'), '<Move>#1 P1</Move>'),
      { code: 'unpaired', found: '1 ID, 2 Move, 1 Time' },
    ],
    ['a.xml', xml('<ID>1</ID>', '<Move>#1 P15'), { code: 'notClosed', place: { line: 4 }, found: 'Move' }],
    ['a.xml', xml(row('#1 P1500')).replace('</NewDataSet>', ''), { code: 'cutShort', place: { line: 6 } }],
    ['a.xml', `<!-- ${xml(row('#1 P1500'))}`, { code: 'cutShort' }],
    ['a.xml', xml(...Array<string>(10_001).fill(row('#1 P1500'))), { code: 'tooManyFrames', found: '10001' }],
    ['a.csv', csv(), { code: 'noFrames' }],
    ['a.csv', 'wave,1', { code: 'noColumn', found: 'Time', place: { line: 1 } }],
    ['a.csv', 'Index,Time\n1,500', { code: 'noColumn', found: 'Servo1', place: { line: 1 } }],
    ['a.csv', 'Index,Time,Servo1,Servo01\n1,500,1,2', { code: 'columnTwice', found: 'Servo01' }],
    [
      'a.csv',
      csv('1,500,1500,1500', '', '2,500,1500.5,1500'),
      { code: 'badPosition', place: { line: 4 }, found: '1500.5' },
    ],
    [
      'a.csv',
      csv('1,500,1500,1500', '2,5e2,1500,1500'),
      { code: 'badTime', place: { line: 3 }, found: '5e2' },
    ],
    ['a.csv', csv('1,,1500,1500'), { code: 'badTime', place: { line: 2 } }],
    ['a.csv', csv('1,500,1500'), { code: 'cellCount', place: { line: 2 }, found: '3 / 4' }],
    ['a.csv', csv('1,500,1500,1500,7'), { code: 'cellCount', place: { line: 2 }, found: '5 / 4' }],
    ['a.json', '{"format":"servodeck-robot"}', { code: 'notOurs' }],
  ];

  test.each(BROKEN)('%s %j', async (name, text, problem) => {
    expect(await read(textFile(name, text))).toMatchObject({ problem });
  });

  test('a .rob file that is encrypted, cut, empty or marked by another program', async () => {
    const rob = bytesIn('step.rob');
    const as = async (bytes: Uint8Array) => read({ name: 'a.rob', bytes });
    expect(await as(bytesIn('secret.rob'))).toMatchObject({ problem: { code: 'encrypted' } });
    expect(await as(rob.slice(0, -1))).toMatchObject({ problem: { code: 'cutShort', place: { frame: 2 } } });
    expect(await as(rob.slice(0, 10))).toMatchObject({ problem: { code: 'cutShort' } });
    expect(await as(rob.with(6, 0))).toMatchObject({ problem: { code: 'noFrames' } });
    expect(await as(rob.with(8, 65))).toMatchObject({ problem: { code: 'unknownTag', found: 'A???' } });
    expect(await as(rob.with(7, 255))).toMatchObject({ problem: { code: 'tooManyFrames' } });
    expect(await as(new Uint8Array([...rob, 1, 2]))).toMatchObject({
      remarks: [{ code: 'bytesBehind', found: '2' }],
    });
  });

  test('a file larger than any group is not even looked at', async () => {
    const bytes = new Uint8Array(MAX_FILE_BYTES + 1);
    expect(await read({ name: 'a.xml', bytes })).toMatchObject({ problem: { code: 'tooLarge' } });
  });
});

describe('what is not in the group is reported', () => {
  test.each([
    [xml(row('#1 P1500 #2 P900 #1 P1600')), 'servoTwice', '1'],
    [`<A><Type>Stepper</Type>${xml(row('#1 P1500'))}</A>`, 'unknownType', 'Stepper'],
    ['Index,Time,Servo1,Note\n1,500,1500,up', 'columnIgnored', 'Note'],
    [csv('2,500,1500,1500', '1,500,1500,1500'), 'indexOrder', ''],
  ])('%j: %s', async (text, code, found) => {
    expect(await read(textFile('a', text))).toMatchObject({ remarks: [{ code, found }] });
  });

  test('of a servo named twice the last position counts', async () => {
    const reading = await read(textFile('a.xml', xml(row('#1 P1500 #2 P900 #1 P1600'))));
    expect(reading).toMatchObject({
      groups: [
        {
          frames: [
            {
              targets: [
                { servo: 1, position: 1600 },
                { servo: 2, position: 900 },
              ],
            },
          ],
        },
      ],
    });
  });
});

describe('a file says more by its content than by its name', () => {
  test.each([
    ['wave.csv', xml(row('#1 P1500'))],
    ['wave', xml(row('#1 P1500'))],
    ['wave.xml', csv('1,500,1500,1500')],
    ['wave.txt', csv('1,500,1500,1500').replaceAll(',', '\t')],
  ])('%s %j', async (name, text) => {
    expect(await read(textFile(name, text))).toMatchObject({ groups: [{ frames: [{ durationMs: 500 }] }] });
  });
});

describe('whatever is chosen', () => {
  /** A group as everything else of the program expects it, or a problem. */
  const holds = async (file: GroupFile): Promise<void> => {
    const reading = await read(file);
    const groups = 'groups' in reading ? reading.groups : [];
    expect('problem' in reading || groups.length > 0).toBe(true);
    for (const group of groups) {
      expect(safeParse(groupSchema, group).issues).toBeUndefined();
      expect(flawOfGroup(group)).toBeNull();
    }
  };

  test('random bytes under any name', async () => {
    const names = fc.constantFrom('a.xml', 'a.csv', 'a.rob', 'a.d6a', 'a.json', 'a');
    const starts = fc.constantFrom(
      '',
      'ACT-40',
      '<NewDataSet><ID>',
      'Time,Servo1\n',
      '{"format":',
      'SQLite format 3\0',
    );
    await fc.assert(
      fc.asyncProperty(names, starts, fc.uint8Array({ maxLength: 600 }), (name, start, rest) =>
        holds({ name, bytes: new Uint8Array([...new TextEncoder().encode(start), ...rest]) }),
      ),
    );
  });

  test('a good file with bytes changed and cut off', async () => {
    const changes = fc.array(fc.tuple(fc.nat(10_000), fc.nat(255)), { maxLength: 4 });
    await fc.assert(
      fc.asyncProperty(fc.constantFrom(...PLAIN), changes, fc.nat(10_000), ({ file }, spots, cut) => {
        const bytes = bytesIn(file);
        for (const [at, value] of spots) bytes[at % bytes.length] = value;
        return holds({ name: file, bytes: cut < bytes.length ? bytes.subarray(0, cut) : bytes });
      }),
    );
  });

  test('text that makes careless patterns run for ever ends at once', async () => {
    const long = 400_000;
    const texts = ['<!--', '<Move ', '<Move>', '#', '# 1', ' ', '\n', '<Type>pwm', '</', '"', ',', '1'].map(
      (piece) => `<a>${piece.repeat(Math.ceil(long / piece.length))}`,
    );
    for (const text of texts) {
      await holds(textFile('a.xml', text));
      await holds(textFile('a.csv', `Time,Servo1\n${text.slice(3)}`));
      await holds(textFile('a.xml', xml(row(text.slice(3).replaceAll('<', '')))));
    }
  });
});
