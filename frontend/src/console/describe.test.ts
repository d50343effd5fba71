import { describe, expect, test } from 'vitest';
import { bytesText, kindOf, meaning } from './describe.ts';

const bytes = Uint8Array.of(0x55, 0x55, 2, 7);
const out = { atMs: 0, bytes, direction: 'out' } as const;
const back = { atMs: 0, bytes, direction: 'in' } as const;

describe('a line of the log', () => {
  test('says a move by servo and position', () => {
    const targets = [
      { servo: 1, position: 1500 },
      { servo: 6, position: 900 },
    ];
    const entry = { ...out, command: { kind: 'move', durationMs: 800, targets } } as const;
    expect(meaning(entry)).toBe('Move 1 → 1500, 6 → 900 in 800 ms');
    expect(kindOf(entry)).toBe('move');
  });

  test('shortens a long move and counts the rest', () => {
    const targets = Array.from({ length: 9 }, (_, index) => ({ servo: index + 1, position: 1500 }));
    const entry = { ...out, command: { kind: 'move', durationMs: 20, targets } } as const;
    expect(meaning(entry)).toContain('6 → 1500 and 3 more in 20 ms');
  });

  test('counts frames from one, as people do', () => {
    const frame = { durationMs: 500, targets: [] };
    const command = { kind: 'download', slot: 5, frameCount: 3, frameIndex: 0, frame } as const;
    expect(meaning({ ...out, command })).toBe('Store frame 1 of 3 in slot 5: nothing in 500 ms');
  });

  test('names what repeats without end', () => {
    const command = { kind: 'run', slot: 2, times: 0 } as const;
    expect(meaning({ ...out, command })).toBe('Run slot 2, until stopped');
  });

  test('says what only some boards know', () => {
    const said = (command: Extract<Parameters<typeof meaning>[0], { command: unknown }>['command']): string =>
      meaning({ ...out, command });
    expect(said({ kind: 'setSpeed', slot: null, percent: 50 })).toBe('Speed of every slot to 50 %');
    expect(said({ kind: 'setSpeed', slot: 8, percent: 300 })).toBe('Speed of slot 8 to 300 %');
    expect(said({ kind: 'release', servos: [1, 2, 3] })).toBe('Release servos 1, 2, 3');
    expect(said({ kind: 'readPositions', servos: [4] })).toBe('Ask where servo 4 stands');
    const positions = [{ servo: 4, position: -3 }];
    expect(meaning({ ...back, report: { kind: 'positions', positions } })).toBe('Positions 4 → -3');
    expect(kindOf({ ...back, report: { kind: 'positions', positions } })).toBe('move');
    expect(meaning({ ...back, report: { kind: 'version', unit: 'us', version: 1 } })).toBe(
      'Version 1, servos in µs',
    );
  });

  test('sorts reports and noise', () => {
    expect(kindOf({ ...back, report: { kind: 'battery', batteryMv: 7500 } })).toBe('battery');
    expect(kindOf({ ...back, report: { kind: 'runAccepted' } })).toBe('group');
    expect(kindOf({ ...back, noise: 'garbage' })).toBe('noise');
    expect(meaning({ ...back, report: { kind: 'battery', batteryMv: 7500 } })).toBe('Battery 7.50\u00a0V');
    expect(meaning({ ...back, noise: 'truncated' })).toBe('Packet cut short, 4 bytes');
  });

  test('shows the bytes as they were', () => {
    expect(bytesText(out as never)).toBe('55 55 02 07');
  });
});
