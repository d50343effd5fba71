// .d6a files are SQLite databases: real ones, through the real SQLite.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import fc from 'fast-check';
import startSqlite from 'sql.js';
import { beforeAll, describe, expect, test } from 'vitest';
import { meaningOf, MEANINGS } from '#shared/testing/groups.ts';
import { readGroupFile } from '#shared/files/readGroupFile.ts';
import { sheetOf } from '#shared/files/csv.ts';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { fileMeans, type FileMeans, type Sqlite } from './means.ts';

const folder = join(import.meta.dirname, '../../../../../shared/protocol/vectors/files');
const bytesIn = (name: string): Uint8Array => new Uint8Array(readFileSync(join(folder, name)));

let sqlite: Sqlite;
let means: FileMeans;
beforeAll(async () => {
  sqlite = await startSqlite();
  means = fileMeans(() => Promise.resolve(sqlite));
});

const read = (name: string, bytes: Uint8Array) => readGroupFile({ name, bytes }, means);

/** A database of another program. */
function databaseOf(...statements: readonly string[]): Uint8Array {
  const database = new sqlite.Database();
  for (const statement of statements) database.run(statement);
  const bytes = database.export();
  database.close();
  return bytes;
}

test.each(MEANINGS)(
  '$file means in the page what its twin says',
  async ({ file, called = file, ...meaning }) => {
    expect(meaningOf(await read(called, bytesIn(file)))).toEqual([meaning]);
  },
);

test('a group saved as a database comes back, servos that are not named included', async () => {
  const frames = [
    { durationMs: 500, targets: [{ servo: 1, position: 500 }] },
    {
      durationMs: 0,
      targets: [
        { servo: 1, position: 2500 },
        { servo: 32, position: 0 },
      ],
    },
  ];
  const group = frames.reduce((made, frame, at) => insertFrame(made, at, frame), emptyGroup('Wave', 'us'));
  const bytes = await means.makeDatabase(sheetOf(group));
  expect(await read('Wave.d6a', bytes)).toEqual({
    groups: [group],
    isUnitMissing: true,
    remarks: [],
  });
  const database = new sqlite.Database(bytes);
  expect(database.exec('SELECT * FROM ActionGroup')).toEqual([
    {
      columns: ['Index', 'Time', 'Servo1', 'Servo32'],
      values: [
        [1, 500, 500, null],
        [2, 0, 2500, 0],
      ],
    },
  ]);
  database.close();
});

describe('a database that is no group says so', () => {
  const TABLE = 'CREATE TABLE ActionGroup ("Index" INTEGER PRIMARY KEY AUTOINCREMENT, Time INT, Servo1 INT)';

  test.each([
    ['noTable', ['CREATE TABLE other (a)']],
    [
      'noTable',
      [
        'CREATE VIEW ActionGroup AS WITH RECURSIVE n(Time) AS (SELECT 1 UNION ALL SELECT Time FROM n) SELECT Time, 1 AS Servo1 FROM n',
      ],
    ],
    ['noFrames', [TABLE]],
    ['noColumn', ['CREATE TABLE ActionGroup (Time INT)', 'INSERT INTO ActionGroup VALUES (1)']],
    ['badPosition', [TABLE, "INSERT INTO ActionGroup VALUES (1, 500, 'far')"]],
    ['badPosition', [TABLE, 'INSERT INTO ActionGroup VALUES (1, 500, 1500.5)']],
    ['badPosition', [TABLE, "INSERT INTO ActionGroup VALUES (1, 500, x'00')"]],
    ['badTime', [TABLE, 'INSERT INTO ActionGroup VALUES (1, NULL, 1500)']],
    ['badTime', [TABLE, 'INSERT INTO ActionGroup VALUES (1, -500, 1500)']],
    [
      'tooManyFrames',
      [
        TABLE,
        'INSERT INTO ActionGroup(Time, Servo1) WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 20000) SELECT i, 1 FROM n',
      ],
    ],
  ])('%s: %j', async (code, statements) => {
    expect(await read('a.d6a', databaseOf(...statements))).toMatchObject({ problem: { code } });
  });

  test('what cannot be fetched is a problem of the file as well', async () => {
    const offline = fileMeans(() => Promise.reject(new Error('no network')));
    expect(await readGroupFile({ name: 'a.d6a', bytes: databaseOf(TABLE) }, offline)).toMatchObject({
      problem: { code: 'damagedDatabase', found: 'no network' },
    });
  });
});

test('a good database with bytes changed and cut off is a group or a problem', async () => {
  const whole = bytesIn('greet.d6a');
  const changes = fc.array(fc.tuple(fc.nat(whole.length - 1), fc.nat(255)), { maxLength: 8 });
  await fc.assert(
    fc.asyncProperty(changes, fc.integer({ min: 16, max: 2 * whole.length }), async (spots, cut) => {
      const bytes = whole.slice(0, cut);
      for (const [at, value] of spots) bytes[at % bytes.length] = value;
      const reading = await read('a.d6a', bytes);
      expect('problem' in reading || reading.groups.length === 1).toBe(true);
    }),
  );
});
