import { describe, expect, test } from 'vitest';
import { encodeCommand } from '#shared/codec/encode.ts';
import type { Command } from '#shared/codec/commands.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { fromHex } from '#shared/codec/packet.ts';
import type { ByteMark } from '#shared/files/recording.ts';
import { arrowOf, bytesText, kindOf, lineText, meaning } from './packetText.ts';
import { searchTest } from './LogPanel.tsx';

const line = (mark: ByteMark, hex: string, board: FamilyId = 'doc') =>
  ({ id: 1, board, entry: { atMs: 1_500, mark, bytes: fromHex(hex) } }) as const;
const sent = (command: Command, board: FamilyId = 'doc') =>
  ({
    id: 1,
    board,
    entry: { atMs: 0, mark: 'sent', bytes: encodeCommand(command, FAMILIES[board]) },
  }) as const;

describe('a line of the log', () => {
  test('says a move by servo and position', () => {
    const targets = [
      { servo: 1, position: 1500 },
      { servo: 6, position: 900 },
    ];
    const entry = sent({ kind: 'move', durationMs: 800, targets });
    expect(meaning(entry)).toBe('Move 1 → 1500, 6 → 900 in 800 ms');
    expect(kindOf(entry)).toBe('move');
  });

  test('shortens a long move and counts the rest', () => {
    const targets = Array.from({ length: 9 }, (_, index) => ({ servo: index + 1, position: 1500 }));
    expect(meaning(sent({ kind: 'move', durationMs: 20, targets }))).toContain(
      '6 → 1500 and 3 more in 20 ms',
    );
  });

  test('counts frames from one, as people do', () => {
    const frame = { durationMs: 500, targets: [] };
    const command = { kind: 'download', slot: 5, frameCount: 3, frameIndex: 0, frame } as const;
    expect(meaning(sent(command))).toBe('Store frame 1 of 3 in slot 5: nothing in 500 ms');
  });

  test('names what repeats without end', () => {
    expect(meaning(sent({ kind: 'run', slot: 2, times: 0 }))).toBe('Run slot 2, until stopped');
  });

  test('says what only some boards know', () => {
    const said = (command: Command): string => meaning(sent(command, 'bus-ctrl'));
    expect(said({ kind: 'setSpeed', slot: null, percent: 50 })).toBe('Speed of every slot to 50 %');
    expect(said({ kind: 'setSpeed', slot: 8, percent: 300 })).toBe('Speed of slot 8 to 300 %');
    expect(said({ kind: 'release', servos: [1, 2, 3] })).toBe('Release servos 1, 2, 3');
    expect(said({ kind: 'readPositions', servos: [4] })).toBe('Read the position of servo 4');
    const positions = line('received', '55 55 06 15 01 04 FD FF', 'bus-ctrl');
    expect(meaning(positions)).toBe('Positions 4 → -3');
    expect(kindOf(positions)).toBe('move');
    expect(meaning(line('received', '55 55 04 01 01 01', 'learm-esp32'))).toBe('Version 1, servos in µs');
  });

  test('means what the board of its time means by it', () => {
    expect(meaning(line('received', '55 55 02 07', 'openarm-new'))).toBe('Group finished by itself');
    expect(meaning(line('received', '55 55 02 07', 'lsc-6'))).toBe('Group was stopped');
  });

  test('sorts reports, noise and what became of the link', () => {
    expect(kindOf(line('received', '55 55 04 0F 4C 1D'))).toBe('battery');
    expect(kindOf(line('received', '55 55 02 06'))).toBe('group');
    expect(kindOf(line('garbage', '41 0D'))).toBe('noise');
    expect(meaning(line('received', '55 55 04 0F 4C 1D'))).toBe('Battery 7.50\u00a0V');
    expect(meaning(line('truncated', '55 55 04 0F'))).toBe('Truncated packet, 4 bytes');
    const lost = { id: 1, board: 'doc', entry: { atMs: 0, mark: 'link', happening: 'lost' } } as const;
    expect([kindOf(lost), meaning(lost), arrowOf(lost.entry), bytesText(lost)]).toEqual([
      'link',
      'Link lost',
      '·',
      '',
    ]);
    const other = { id: 1, board: 'xarm', entry: { atMs: 0, mark: 'board', board: 'xarm' } } as const;
    expect([kindOf(other), meaning(other)]).toEqual(['link', 'From here on the board is xArm']);
  });

  test('says what is no command of ours', () => {
    expect(meaning(line('sent', '55 55 02 63'))).toBe('Command 99, unknown to this board');
    expect(meaning(line('sent', '00 FD FD'))).toBe('Filler after a truncated packet, 3 bytes');
    expect(kindOf(line('sent', '55 55 02 63'))).toBe('group');
  });

  test('is copied as it stands in a saved log', () => {
    expect(lineText(line('sent', '55 55 02 07'))).toBe('1.500  >  55 55 02 07  # Stop');
  });
});

describe('a search', () => {
  const entry = line('received', '55 55 04 0F 4C 1D');

  test.each(['', 'battery', 'BATT', '0F 4C', '0f4c', '55 55 04'])('%j finds it', (query) => {
    expect(searchTest(query, 'en')(entry)).toBe(true);
  });

  test.each(['stop', '4C 0F', 'F4', 'zz', '1D 00'])('%j does not', (query) => {
    expect(searchTest(query, 'en')(entry)).toBe(false);
  });
});
