// Values survive the wire: every command and report a family has comes back as it went in. What is refused is mostly
// vectors (vectors.test.ts); here is what JSON or the families cannot say.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import type { Command, Frame, ServoTarget } from './commands.ts';
import { createDecoder } from './decoder.ts';
import { encodeCommand, encodeReport, RangeRefusal } from './encode.ts';
import { FAMILIES, positionRange, type Family, type Range } from './families.ts';
import type { Packet } from './packet.ts';
import { parseCommand, parseReport } from './parse.ts';
import type { Report } from './reports.ts';
import { COMMAND_SHAPES, REPORT_SHAPES, type ShapeRule } from './shapes.ts';

const within = (range: Range): fc.Arbitrary<number> => fc.integer(range);

function targetsOf(row: Family, least: number, most: number): fc.Arbitrary<ServoTarget[]> {
  const target = within(row.servo).chain((servo) =>
    within(positionRange(row, servo)).map((position) => ({ servo, position })),
  );
  return fc.uniqueArray(target, { selector: ({ servo }) => servo, minLength: least, maxLength: most });
}

function servosOf(row: Family): fc.Arbitrary<number[]> {
  return fc.uniqueArray(within(row.servo), { minLength: 1, maxLength: row.servosPerMove });
}

function frameOf(row: Family, least: number, most: number): fc.Arbitrary<Frame> {
  return fc.record({ durationMs: within(row.durationMs), targets: targetsOf(row, least, most) });
}

function downloadOf(row: Family): fc.Arbitrary<Command> {
  return fc
    .record({
      slot: within(row.slot),
      frameCount: within({ min: 1, max: row.framesPerGroup }),
      part: fc.nat(),
      frame: frameOf(row, 0, row.servosPerFrame),
    })
    .map(({ part, ...rest }) => ({ kind: 'download', frameIndex: part % rest.frameCount, ...rest }));
}

function commandOf(row: Family): fc.Arbitrary<Command> {
  const byKind: Record<Command['kind'], fc.Arbitrary<Command>> = {
    move: frameOf(row, 1, row.servosPerMove).map((frame) => ({ kind: 'move', ...frame })),
    run: fc.record({ kind: fc.constant('run'), slot: within(row.slot), times: within(row.runTimes) }),
    stop: fc.constant({ kind: 'stop' }),
    erase: fc.constant({ kind: 'erase' }),
    readBattery: fc.constant({ kind: 'readBattery' }),
    download: downloadOf(row),
    setSpeed: fc.record({
      kind: fc.constant('setSpeed'),
      slot: fc.option(within(row.slot), { nil: null }),
      percent: within(row.speedPercent),
    }),
    release: servosOf(row).map((servos) => ({ kind: 'release', servos })),
    readPositions: servosOf(row).map((servos) => ({ kind: 'readPositions', servos })),
    readVersion: fc.constant({ kind: 'readVersion' }),
    readAllPositions: fc.constant({ kind: 'readAllPositions' }),
    readOffsets: fc.constant({ kind: 'readOffsets' }),
  };
  return fc.oneof(...row.commands.map((kind) => byKind[kind]));
}

function sixOf<T>(entry: fc.Arbitrary<T>): fc.Arbitrary<T[]> {
  return fc.array(entry, { minLength: 6, maxLength: 6 });
}

const byte = within({ min: 0, max: 0xff });
const word = within({ min: 0, max: 0xffff });

const positions: fc.Arbitrary<Report> = fc.record({
  kind: fc.constant('positions'),
  positions: fc.array(fc.record({ servo: byte, position: within({ min: -0x8000, max: 0x7fff }) }), {
    minLength: 1,
    maxLength: 32,
  }),
});
const allPositions: fc.Arbitrary<Report> = fc.record({
  kind: fc.constant('allPositions'),
  positions: sixOf(fc.record({ servo: byte, position: within({ min: -0x8000, max: 0x7fff }) })),
});
const offsets: fc.Arbitrary<Report> = fc.record({
  kind: fc.constant('offsets'),
  offsets: sixOf(fc.record({ servo: byte, offset: within({ min: -0x80, max: 0x7f }) })),
});
const version: fc.Arbitrary<Report> = fc.record({
  kind: fc.constant('version'),
  unit: fc.constantFrom('us', 'steps'),
  version: byte,
});

function reportOf({ answers, emptySeven, runReportsNameSlot }: Family): fc.Arbitrary<Report> {
  const kinds: fc.Arbitrary<Report>[] = runReportsNameSlot
    ? [
        fc.record({ kind: fc.constant('runStarted'), slot: byte, times: word }),
        fc.record({ kind: fc.constant('runFinished'), slot: byte }),
        fc.constant({ kind: 'runStopped' }),
      ]
    : [fc.constant({ kind: 'erased' }), fc.constant({ kind: 'frameStored' })];
  if (answers.includes('run')) kinds.push(fc.constant({ kind: 'runAccepted' }));
  if (emptySeven === 'runFinished') kinds.push(fc.constant({ kind: 'runFinished', slot: null }));
  if (answers.includes('readBattery'))
    kinds.push(fc.record({ kind: fc.constant('battery'), batteryMv: word }));
  if (answers.includes('readPositions')) kinds.push(positions);
  if (answers.includes('readVersion')) kinds.push(version);
  if (answers.includes('readAllPositions')) kinds.push(allPositions);
  if (answers.includes('readOffsets')) kinds.push(offsets);
  return fc.oneof(...kinds);
}

/** Over the wire: everything in one piece, then silence. */
function receive(packets: readonly Uint8Array[], shape: ShapeRule): Packet[] {
  const received: Packet[] = [];
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') received.push(event.packet);
  }, shape);
  decoder.push(Uint8Array.from(packets.flatMap((packet) => Array.from(packet))));
  decoder.idle();
  return received;
}

describe.each(Object.values(FAMILIES))('$id', (row) => {
  test('commands come off the wire as they went on', () => {
    fc.assert(
      fc.property(fc.array(commandOf(row), { maxLength: 8 }), (commands) => {
        const packets = receive(
          commands.map((command) => encodeCommand(command, row)),
          COMMAND_SHAPES,
        );
        expect(packets.map(parseCommand)).toEqual(commands);
      }),
    );
  });

  test('reports come off the wire as they went on', () => {
    fc.assert(
      fc.property(fc.array(reportOf(row), { maxLength: 8 }), (reports) => {
        const packets = receive(reports.map(encodeReport), REPORT_SHAPES);
        expect(packets.map((packet) => parseReport(packet, row))).toEqual(reports);
      }),
    );
  });

  test('no packet is longer than the board can take', () => {
    fc.assert(
      fc.property(commandOf(row), (command) => {
        expect(encodeCommand(command, row).length - 2).toBeLessThanOrEqual(row.maxLength);
      }),
    );
  });
});

describe('encoding refuses', () => {
  const { doc } = FAMILIES;
  const oneServo = (position: number): Command => ({
    kind: 'move',
    durationMs: 100,
    targets: [{ servo: 1, position }],
  });

  test.each([Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY])(
    'the position %d',
    (position) => {
      expect(() => encodeCommand(oneServo(position), doc)).toThrow(RangeRefusal);
      expect(() => encodeCommand(oneServo(position), doc)).toThrow(
        `position of servo 1 is ${position}, allowed whole numbers 500..2500 µs`,
      );
    },
  );

  test.each([
    { kind: 'run', slot: Number.NaN, times: 1 },
    { kind: 'run', slot: 1, times: Number.NaN },
    { ...oneServo(1500), durationMs: Number.NaN },
    {
      kind: 'download',
      slot: 0,
      frameCount: Number.NaN,
      frameIndex: 0,
      frame: { durationMs: 0, targets: [] },
    },
    {
      kind: 'download',
      slot: 0,
      frameCount: 1,
      frameIndex: Number.NaN,
      frame: { durationMs: 0, targets: [] },
    },
  ] as const)('a value that is no number: %j', (command) => {
    expect(() => encodeCommand(command as Command, doc)).toThrow(RangeRefusal);
  });

  test('a packet longer than a board can take', () => {
    const short: Family = { ...doc, maxLength: 10 };
    const two: Command = {
      kind: 'move',
      durationMs: 100,
      targets: [
        { servo: 1, position: 1500 },
        { servo: 2, position: 1500 },
      ],
    };
    expect(encodeCommand(oneServo(1500), short)).toHaveLength(10);
    expect(() => encodeCommand(two, short)).toThrow('length is 11, allowed 2..10');
  });

  test('a report that does not fit its fields', () => {
    expect(() => encodeReport({ kind: 'battery', batteryMv: 65_536 })).toThrow(
      'batteryMv is 65536, allowed 0..65535 mV',
    );
    expect(() => encodeReport({ kind: 'runStarted', slot: 256, times: 1 })).toThrow(
      'slot is 256, allowed 0..255',
    );
    expect(() => encodeReport({ kind: 'runFinished', slot: -1 })).toThrow('slot is -1, allowed 0..255');
  });
});

describe('parsing', () => {
  test.each([
    ['an unknown command', 99, []],
    ['a stop with a parameter', 7, [1]],
    ['a run without its times', 6, [1]],
    ['an erase with two bytes', 8, [0, 0]],
    ['a speed without its percent', 11, [8]],
    ['a release that lacks a servo', 20, [2, 1]],
    ['a question for positions with a servo too many', 21, [1, 1, 2]],
    ['a version answer', 1, [1, 1]],
    ['a battery answer', 15, [0x4c, 0x1d]],
    ['a move without anything', 3, []],
    ['a move that lacks its entry', 3, [1, 0xe8, 0x03]],
    ['a move with a byte too many', 3, [1, 0xe8, 0x03, 1, 0xd0, 0x07, 0]],
    ['a download whose count is wrong', 25, [5, 2, 0, 2, 0xe8, 0x03, 1, 0xdc, 0x05]],
    ['a download cut before its time', 25, [5, 2, 0, 0]],
  ])('%s is no command', (_name, command, params) => {
    expect(parseCommand({ command, params: Uint8Array.from(params) })).toBeNull();
  });

  test('an empty 7 stays unknown where its meaning is unknown', () => {
    const packet: Packet = { command: 7, params: new Uint8Array(0) };
    const report = parseReport(packet, { ...FAMILIES.doc, emptySeven: 'unknown' });
    expect(report).toEqual({ kind: 'unknown', command: 7, params: new Uint8Array(0) });
  });
});
