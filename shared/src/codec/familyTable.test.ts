// shared/protocol/families.json: its rows are what their types say and tell where their figures come from. What comes of them is
// shared/protocol/vectors/families.json, which the gateway reads the same; after a change of the table:
// `npx vitest run shared/src/codec/familyTable.test.ts -u`.

import * as v from 'valibot';
import { expect, test } from 'vitest';
import data from '../../protocol/families.json' with { type: 'json' };
import { COMMAND_NUMBER, type CommandKind } from './commands.ts';
import { FAMILIES, UNKNOWN_BOARD, type BoardId, type Family } from './families.ts';

const FILE = new URL('../../protocol/vectors/families.json', import.meta.url);
const all: readonly Family[] = [...Object.values(FAMILIES), UNKNOWN_BOARD];

const whole = v.pipe(v.number(), v.integer(), v.minValue(0));
const range = v.pipe(
  v.strictObject({ min: whole, max: whole }),
  v.check(({ min, max }) => min <= max, 'min is more than max'),
);
const command = v.picklist(Object.keys(COMMAND_NUMBER) as CommandKind[]);
const button = v.picklist([
  ...(['start', 'up', 'down', 'left', 'right', 'triangle', 'cross', 'square', 'circle'] as const),
  ...(['l1', 'r1', 'l2', 'r2'] as const),
]);
const motion = v.strictObject({
  tickMs: whole,
  talkMs: v.pipe(v.number(), v.minValue(0)),
  timing: v.picklist(['shared', 'perServo', 'unknown']),
  partMs: v.nullable(v.number()),
  groups: v.picklist(['deadlines', 'polled']),
  haltedByStop: v.array(whole),
  chainedSlot: v.nullable(whole),
});
const row = v.strictObject({
  id: v.picklist(all.map(({ id }) => id) as [BoardId, ...BoardId[]]),
  name: v.pipe(v.string(), v.nonEmpty()),
  unit: v.picklist(['us', 'steps']),
  position: range,
  servoPosition: v.record(v.pipe(v.string(), v.regex(/^\d+$/)), range),
  centre: whole,
  servo: range,
  usualServoCount: whole,
  servosPerMove: whole,
  servosPerFrame: whole,
  durationMs: range,
  shortestMoveMs: whole,
  framesPerGroup: whole,
  slot: range,
  runTimes: range,
  speedPercent: range,
  zeroTimes: v.picklist(['endless', 'once']),
  maxLength: whole,
  commands: v.array(command),
  eraseLength: v.picklist([2, 3]),
  answers: v.array(command),
  certainAnswers: v.array(v.picklist(['readBattery', 'readVersion', 'readPositions'])),
  runReportsNameSlot: v.boolean(),
  emptySeven: v.picklist(['runFinished', 'runStopped', 'unknown']),
  queryKillsRun: v.boolean(),
  leftOverBytes: whole,
  stopConfirmedBy: v.nullable(v.picklist(['readBattery', 'readVersion', 'readPositions'])),
  resyncFiller: v.nullable(whole),
  neverSend: v.array(whole),
  ignoresUnknown: v.boolean(),
  serviceGapMs: whole,
  motion,
  batteryCeilingMv: v.nullable(whole),
  padButtons: v.array(v.nullable(button)),
  selectSlots: v.array(whole),
  keySlot: v.nullable(whole),
});

test.each(all)('$id has all fields, each as its type says', (family) => {
  const read: Family = v.parse(row, family);
  expect(read).toEqual(family);
});

test('each row stands on a base that is there, and says why of fields only', () => {
  const rows: readonly { base?: string; why?: object }[] = [
    ...Object.values(data.bases),
    ...Object.values(data.families),
    data.unknown,
  ];
  const fields = ['row', ...Object.keys(row.entries), ...Object.keys(motion.entries)];
  for (const { base, why = {} } of rows) {
    expect(base ?? 'openFirmware').toBeOneOf(Object.keys(data.bases));
    for (const field of Object.keys(why)) expect(field).toBeOneOf(fields);
  }
});

/** One field a line. */
function written(families: readonly Family[]): string {
  const rows = families.map((family) => {
    const lines = Object.entries(family).map(([name, value]) => `  "${name}": ${JSON.stringify(value)}`);
    return `{\n${lines.join(',\n')}\n}`;
  });
  return `[${rows.join(', ')}]\n`;
}

test('the table in full is what the gateway is held to', async () => {
  await expect(written(all)).toMatchFileSnapshot(FILE.pathname);
});
