import { describe, expect, test } from 'vitest';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import { words } from '../../i18n/whole.ts';
import { judgeText, obstacleFor } from './packetText.ts';

const judge = (text: string, board: FamilyId = 'doc') => judgeText(text, FAMILIES[board]);
const READY = { ...INITIAL_STATE, link: { status: 'ready' } } as const;
const LATCHED = { ...READY, latch: { reason: 'pressed', by: null, stop: 'sent', unheld: null } } as const;

describe('a packet that is being typed', () => {
  test.each([
    ['', words.raw.hint],
    ['5', words.raw.hint],
    ['55 5', 'Continue with 55 55, LEN and the command'],
    ['55 55 02', 'Incomplete: 1 byte missing for this LEN'],
    ['55 55 02 0', 'Incomplete: 1 byte missing for this LEN'],
    ['5555020f', 'Read the battery'],
    ['55 55 02 0F 00', 'Too long: 1 byte more than LEN states.'],
    ['55 55 01', 'LEN 1 is too small; it counts itself and the command, so it is 2 at least.'],
    ['55 55 ff', 'LEN 255 is too large; LSC-compatible board takes 253 at most.'],
    ['41', 'A packet begins with 55 55.'],
    ['55 55 02 06', '“Run” has another format; the board would use bytes of earlier packets.'],
    ['55 55 03 08', 'This writes to the board’s memory and needs its answers: use the Board panel.'],
    ['55 55 02 63', 'Command 99 is unknown to LSC-compatible board, which ignores it'],
    ['battery', words.raw.notHex],
  ])('%j is explained', (text, explanation) => {
    expect(judge(text).explanation).toBe(explanation);
  });

  test('is refused where the family must not get it, or is unknown', () => {
    expect(judge('55 55 02 0C', 'learm-esp32').explanation).toMatch(/^Command 12 is never sent to LeArm AI/u);
    expect(judge('55 55 02 63', 'lsc-6')).toMatchObject({ packet: null, isRefused: true });
    expect(judge('55 55 08 03 01 E8 03 01 28 0A').explanation).toContain(
      'position of servo 1 is 2600, allowed is 500 to 2500',
    );
  });

  test('can be sent once it is whole, to a robot that is there', () => {
    expect(judge('55 55 02 0').packet).toBeNull();
    const judged = judge('55 55 02 0F');
    expect(judged.packet).toEqual(Uint8Array.of(0x55, 0x55, 2, 15));
    expect(obstacleFor(judged, READY)).toBeNull();
    expect(obstacleFor(judged, INITIAL_STATE)).toBe(words.servos.blocked.closed);
    expect(obstacleFor(judged, { ...READY, activity: { kind: 'erasing' } })).toBe(words.servos.blocked.busy);
  });

  test('waits for Resume where it may move something', () => {
    expect(obstacleFor(judge('55 55 02 0F'), LATCHED)).toBeNull();
    expect(obstacleFor(judge('55 55 05 06 01 01 00'), LATCHED)).toBe(words.raw.waits);
    expect(obstacleFor(judge('55 55 02 63'), LATCHED)).toBe(words.raw.waits);
  });
});
