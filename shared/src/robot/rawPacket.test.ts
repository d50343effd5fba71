import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { COMMAND_NUMBER } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { FAMILIES, UNKNOWN_BOARD, type Family } from '../codec/families.ts';
import { fromHex, packetBytes } from '../codec/packet.ts';
import { judgeRaw } from '../robot/raw.ts';

const judge = (hex: string, family: Family = FAMILIES.doc) => judgeRaw(fromHex(hex), family);
const refusal = (code: string) => ({ kind: 'refused', reason: expect.objectContaining({ code }) as unknown });
const families = [...Object.values(FAMILIES), UNKNOWN_BOARD];
const anyFamily = fc.constantFrom(...families);
/** Shaped as packets are, whatever they say. */
const anyPacket = fc
  .tuple(fc.integer({ min: 0, max: 255 }), fc.uint8Array({ maxLength: 40 }))
  .map(([number, params]) => packetBytes(number, params));
/** Like those that some board takes: numbers of commands, counts that fit, values around the limits. */
const targets = fc.array(
  fc.tuple(fc.integer({ min: 0, max: 7 }), fc.constantFrom(0, 1, 2, 3, 9, 10), fc.nat(255)),
  {
    maxLength: 4,
  },
);
const likelyPacket = fc.oneof(
  targets.map((entries) =>
    packetBytes(3, [entries.length, 0xe8, 3, ...entries.flatMap(([servo, high, low]) => [servo, low, high])]),
  ),
  fc.tuple(fc.nat(255), fc.nat(300)).map(([slot, times]) => packetBytes(6, [slot, times & 0xff, times >> 8])),
  fc.constantFrom(1, 7, 8, 15).map((number) => packetBytes(number, [])),
  fc
    .tuple(fc.constantFrom(20, 21), fc.uint8Array({ maxLength: 7, max: 7 }))
    .map(([number, servos]) => packetBytes(number, [servos.length, ...servos])),
);

describe('a packet by hand', () => {
  test.each([
    ['', { kind: 'incomplete', missing: null }],
    ['55', { kind: 'incomplete', missing: null }],
    ['55 55', { kind: 'incomplete', missing: null }],
    ['55 55 02', { kind: 'incomplete', missing: 1 }],
    ['55 55 02 0F', { kind: 'command', command: { kind: 'readBattery' } }],
    ['55 55 02 0F 00', { kind: 'refused', reason: { code: 'tooLong', extra: 1 } }],
    ['55 54', refusal('noHeader')],
    ['02 0F', refusal('noHeader')],
    ['55 55 01', refusal('shortLength')],
    ['55 55 FE', refusal('longLength')],
    ['55 55 08 03 01 E8', { kind: 'incomplete', missing: 4 }],
    ['55 55 02 63', { kind: 'ignored', number: 0x63 }],
  ])('%j is judged as it is typed', (hex, verdict) => {
    expect(judge(hex)).toEqual(verdict);
  });

  test("a known number in another shape would act on earlier packets' bytes (S13, S14)", () => {
    expect(judge('55 55 02 06')).toEqual({ kind: 'refused', reason: { code: 'otherShape', command: 'run' } });
    expect(judge('55 55 08 03 02 E8 03 01 D0 07')).toEqual(refusal('otherShape'));
    expect(judge('55 55 03 0F 00')).toEqual(refusal('otherShape'));
  });

  test('flash is not written by hand, refused as soon as the number is there', () => {
    expect(judge('55 55 03 08')).toEqual(refusal('flash'));
    expect(judge('55 55 0B 19')).toEqual(refusal('flash'));
    expect(judge('55 55 02 08', FAMILIES['learm-esp32'])).toEqual(refusal('flash'));
  });

  test('limits hold as everywhere, with their figures', () => {
    expect(judge('55 55 08 03 01 E8 03 01 28 0A')).toMatchObject({
      kind: 'refused',
      reason: { code: 'limits', refusal: { field: 'position', servo: 1, value: 2600, min: 500, max: 2500 } },
    });
  });

  test('an unknown number goes only to a board that ignores it', () => {
    expect(judge('55 55 02 0F', FAMILIES['openarm-new'])).toEqual({ kind: 'ignored', number: 15 });
    expect(judge('55 55 02 63', FAMILIES['lsc-6'])).toEqual(refusal('unknownNumber'));
    expect(judge('55 55 02 63', FAMILIES['learm-esp32'])).toEqual(refusal('unknownNumber'));
    expect(judge('55 55 05 06 01 01 00', UNKNOWN_BOARD)).toEqual(refusal('unknownNumber'));
  });

  test('what must never be sent is refused as such, also where unknown numbers may', () => {
    const careful = { ...FAMILIES.doc, neverSend: [0x63] };
    expect(judge('55 55 02 63', careful)).toEqual(refusal('neverSend'));
    expect(judge('55 55 05 08', FAMILIES.xarm)).toEqual(refusal('neverSend'));
  });

  test('what passes is what the family takes from the program too, byte by byte', () => {
    let passed = 0;
    fc.assert(
      fc.property(anyFamily, likelyPacket, (family, bytes) => {
        const verdict = judgeRaw(bytes, family);
        if (verdict.kind !== 'command') return;
        passed += 1;
        expect(['erase', 'download']).not.toContain(verdict.command.kind);
        expect(encodeCommand(verdict.command, family)).toEqual(bytes);
      }),
    );
    expect(passed).toBeGreaterThan(5);
  });

  test('what a family must not get never passes, whole or begun', () => {
    for (const family of families) {
      for (const number of [...family.neverSend, COMMAND_NUMBER.erase, COMMAND_NUMBER.download]) {
        if (family.ignoresUnknown && !family.commands.some((kind) => COMMAND_NUMBER[kind] === number))
          continue;
        for (let params = 0; params <= family.maxLength - 2; params++) {
          const bytes = packetBytes(number, new Uint8Array(params));
          expect(judgeRaw(bytes, family).kind).toBe('refused');
          expect(judgeRaw(bytes.subarray(0, 4), family).kind).toBe('refused');
        }
      }
    }
  });

  test('any bytes get a verdict, and each whole packet a final one', () => {
    fc.assert(
      fc.property(anyFamily, fc.uint8Array({ maxLength: 30 }), anyPacket, (family, bytes, packet) => {
        expect(['command', 'ignored', 'incomplete', 'refused']).toContain(judgeRaw(bytes, family).kind);
        expect(judgeRaw(packet, family).kind).not.toBe('incomplete');
      }),
    );
  });
});
