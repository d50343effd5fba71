// What is saved is read back the same, in our words and in the vendors'; what a format cannot hold is reported before.

import { toJsonSchema } from '@valibot/to-json-schema';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import publishedFile from '../../../docs/group.schema.json' with { type: 'json' };
import { FAMILIES } from '../codec/families.ts';
import { emptyGroup, totalDurationMs, type ActionGroup, groupFileSchema } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { fileNameOf, namedByFile } from './fileName.ts';
import { filled } from './fit.ts';
import { lossesIn, SAVE_FORMATS, writeGroupFile, type SaveFormat } from './writeGroupFile.ts';
import { readGroupFile } from './readGroupFile.ts';
import type { Sheet } from './csv.ts';

const family = FAMILIES['openarm-new'];
const robot = readyRobot('arm', 'openarm-new', {
  robot: 'Arm',
  role: (role, servo) => `${role} ${servo}`,
  limb: (limb) => limb,
});

/** The database stays a table: what SQLite makes of it is the page's. */
async function save(format: SaveFormat, group: ActionGroup) {
  let sheet: Sheet = { columns: [], rows: [] };
  const saved = await writeGroupFile(format, group, { family, robot }, (made) => {
    sheet = made;
    return Promise.resolve(new TextEncoder().encode('SQLite format 3\0'));
  });
  if ('misfits' in saved) return saved;
  const bytes = typeof saved.content === 'string' ? new TextEncoder().encode(saved.content) : saved.content;
  return readGroupFile(
    { name: saved.name, bytes },
    {
      decode: (text, encoding) => new TextDecoder(encoding, { fatal: true }).decode(text),
      openDatabase: () => Promise.resolve(sheet),
    },
  );
}

type Poses = readonly (readonly [durationMs: number, positions: Readonly<Record<number, number>>])[];

const groupOf = (poses: Poses, about: Partial<ActionGroup> = {}): ActionGroup =>
  poses.reduce(
    (group, [durationMs, positions]) =>
      insertFrame(group, group.frames.length, {
        durationMs,
        targets: Object.entries(positions).map(([servo, position]) => ({ servo: Number(servo), position })),
      }),
    { ...emptyGroup('Wave', 'us'), ...about },
  );

const WAVE = groupOf([
  [1000, { 1: 1500, 2: 900 }],
  [400, { 1: 700, 2: 2100 }],
]);

describe.each(['json', 'xml', 'd6a', 'rob', 'csv'] as const)('a group saved as %s', (format) => {
  /** .rob files hold steps. */
  const unit = format === 'rob' ? 'steps' : 'us';

  test('comes back the same, whatever whole poses it has', async () => {
    const servos = fc.uniqueArray(fc.integer({ min: 1, max: 40 }), { minLength: 1, maxLength: 32 });
    const duration = fc.integer({ min: 0, max: 0xffff });
    const position = fc.integer({ min: 0, max: 2500 });
    const poses = servos.chain((numbers) =>
      fc.array(
        fc.tuple(
          duration,
          fc
            .array(position, { minLength: numbers.length, maxLength: numbers.length })
            .map((at) => Object.fromEntries(numbers.map((servo, index) => [servo, at[index] ?? 0]))),
        ),
        { minLength: 1, maxLength: 12 },
      ),
    );
    const slot = fc.option(fc.integer({ min: 0, max: 255 }));
    await fc.assert(
      fc.asyncProperty(poses, slot, async (wanted, at) => {
        const group = groupOf(wanted, { unit, slot: at });
        const reading = await save(format, group);
        expect(reading).toMatchObject({ remarks: [] });
        // A table does not say its unit; the person does.
        expect('groups' in reading && reading.groups.map((one) => ({ ...one, unit }))).toEqual([group]);
      }),
    );
  });

  test('says its unit or asks for it', async () => {
    expect(await save(format, groupOf([[500, { 1: 700 }]], { unit }))).toMatchObject({
      isUnitMissing: format === 'csv' || format === 'd6a',
      groups: [{ unit }],
    });
  });
});

test('XML is what the vendor program reads: a byte order mark, one table, number for number', async () => {
  const saved = await writeGroupFile('xml', WAVE, { family, robot }, () => Promise.reject(new Error('no')));
  expect(saved).toEqual({
    name: 'Wave.xml',
    content: [
      '\uFEFF<?xml version="1.0" encoding="utf-8"?>',
      '<NewDataSet>',
      '  <Type>PWM Servo</Type>',
      '  <Table>',
      '    <ID>1</ID>',
      '    <Move>#1 P1500 #2 P900</Move>',
      '    <Time>T1000</Time>',
      '    <ID>2</ID>',
      '    <Move>#1 P700 #2 P2100</Move>',
      '    <Time>T400</Time>',
      '  </Table>',
      '</NewDataSet>',
      '',
    ].join('\n'),
  });
});

test('pulse widths are no steps: a .rob file of them would be read as another motion', async () => {
  expect(await save('rob', WAVE)).toMatchObject({ misfits: [{ code: 'unit' }] });
});

test('a servo of which a .rob file knows nothing is refused, with its frames', async () => {
  expect(
    await save(
      'rob',
      groupOf(
        [
          [500, { 1: 500 }],
          [500, { 1: 600, 41: 500 }],
        ],
        { unit: 'steps' },
      ),
    ),
  ).toEqual({
    misfits: [
      {
        ...{ code: 'servo', servo: 41, frames: [2] },
        values: { min: 41, max: 41 },
        allowed: { min: 1, max: 40 },
      },
    ],
  });
});

describe('other programs know no servo under way', () => {
  const group = groupOf([
    [1000, { 1: 1000 }],
    [300, { 2: 500 }],
    [100, {}],
    [600, { 1: 2000 }],
  ]);

  test('so it is where it would be at the end of each frame, once it has been anywhere', () => {
    expect(filled(group)).toEqual({
      frames: [
        { durationMs: 1000, targets: [{ servo: 1, position: 1000 }] },
        {
          durationMs: 300,
          targets: [
            { servo: 1, position: 1300 },
            { servo: 2, position: 500 },
          ],
        },
        {
          durationMs: 100,
          targets: [
            { servo: 1, position: 1400 },
            { servo: 2, position: 500 },
          ],
        },
        {
          durationMs: 600,
          targets: [
            { servo: 1, position: 2000 },
            { servo: 2, position: 500 },
          ],
        },
      ],
      completed: [2, 3, 4],
      lacking: [1],
    });
  });

  test('frames of no length are no division by nothing', () => {
    const still = groupOf([
      [0, { 1: 1000 }],
      [0, { 2: 500 }],
      [0, { 1: 2000 }],
    ]);
    expect(filled(still).frames[1]?.targets).toContainEqual({ servo: 1, position: 2000 });
  });

  test('filled once, there is nothing left to fill, and no key has moved', () => {
    const position = fc.integer({ min: 500, max: 2500 });
    const pose = fc.dictionary(fc.constantFrom('1', '2', '3'), position);
    const poses = fc.array(fc.tuple(fc.integer({ min: 0, max: 3000 }), pose), { maxLength: 8 });
    fc.assert(
      fc.property(poses, (wanted) => {
        const sparse = groupOf(wanted);
        const { frames } = filled(sparse);
        const again = groupOf(
          frames.map(({ durationMs, targets }) => [
            durationMs,
            Object.fromEntries(targets.map((target) => [target.servo, target.position])),
          ]),
        );
        expect(filled(again)).toMatchObject({ frames, completed: [] });
        expect(totalDurationMs(frames)).toBe(totalDurationMs(sparse.frames));
        sparse.frames.forEach(({ targets }, index) => {
          expect(frames[index]?.targets).toEqual(expect.arrayContaining([...targets]));
        });
      }),
    );
  });
});

describe('what is lost', () => {
  const rich: ActionGroup = {
    ...groupOf([
      [500, { 1: 1500 }],
      [500, { 2: 900 }],
    ]),
    times: 3,
    tags: ['hello'],
    markers: [{ id: 3, atMs: 0, text: 'go' }],
    nextId: 4,
  };
  const eased: ActionGroup = {
    ...rich,
    frames: rich.frames.map((frame, index) => (index === 1 ? { ...frame, easing: 'inOut' } : frame)),
  };
  const codes = (format: SaveFormat) => lossesIn(format, eased).map(({ code }) => code);

  test('is nothing in our own file, and reported of each other', () => {
    expect(codes('json')).toEqual([]);
    expect(codes('xml')).toEqual(['easings', 'marks', 'about', 'times', 'completed', 'lacking']);
    expect(codes('python')).toEqual(['marks', 'about', 'completed']);
    expect(lossesIn('csv', eased).at(0)).toEqual({ code: 'easings', frames: [2] });
  });

  test('is nothing of a plain group', () => {
    expect(SAVE_FORMATS.flatMap((format) => lossesIn(format, WAVE))).toEqual([]);
  });
});

describe('a name of a file', () => {
  test.each([
    ['12号.xml', '12号', 12],
    ['挥手 12号.xml', '挥手', 12],
    ['No.10 wave.xml', 'wave', 10],
    ['no 7.xml', 'no 7', 7],
    ['10 wave hand.d6a', 'wave hand', 10],
    ['10.rob', '10', 10],
    ['300 spins.xml', '300 spins', null],
    ['2fast.xml', '2fast', null],
    ['wave 2.xml', 'wave 2', null],
    ['.xml', '.xml', null],
    ['Nora.csv', 'Nora', null],
  ])('%s is %j in slot %j', (file, name, slot) => {
    expect(namedByFile(file)).toEqual({ name, slot });
  });

  test('says the slot when it has one, and nothing a file system does not bear', () => {
    expect(fileNameOf({ name: 'Wave: a/b', slot: 12 }, '.xml')).toBe('12 Wave ab.xml');
    expect(fileNameOf({ name: '?', slot: null }, '.csv')).toBe('group.csv');
  });

  test('of a sketch are such as Arduino’s programs open', () => {
    const called = (name: string, slot: number | null) => fileNameOf({ name, slot }, '.ino');
    expect(called('Wave: a/b', 12)).toBe('12_Wave_ab.ino');
    expect(called('Grüße', null)).toBe('Gru_e.ino');
    expect(called('挥手', 7)).toBe('7.ino');
    expect(called('挥手', null)).toBe('group.ino');
    expect(called('-.a.', null)).toBe('a.ino');
    expect(called('a'.repeat(64), 255)).toHaveLength(63);
  });
});

test('the published schema is the one that groups are read by', () => {
  expect(toJsonSchema(groupFileSchema, { target: 'draft-2020-12', ignoreActions: ['trim'] })).toEqual(
    publishedFile,
  );
});
