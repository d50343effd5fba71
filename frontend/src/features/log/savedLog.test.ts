import { expect, test } from 'vitest';
import { readRecording } from '#shared/files/recordingText.ts';
import { createTrafficLog } from '../../robot/traffic.ts';
import { logFile } from './logView.ts';

test('a log is saved with board and date in its name, each packet in its own words, and can be read back', () => {
  const log = createTrafficLog();
  const ended = {
    atMs: 10,
    direction: 'in',
    bytes: Uint8Array.of(0x55, 0x55, 2, 7),
    report: { kind: 'runStopped' },
  } as const;
  log.add(ended, 'openarm-new');
  log.add({ ...ended, atMs: 20 }, 'lsc-6');
  const { name, text } = logFile(log, 'lsc-6', 'COM3', new Date('2026-11-21T09:30:00Z'));
  expect(name).toBe('servodeck-lsc-6-2026-11-21T0930.txt');
  expect(text).toContain('0.010  <  55 55 02 07  # Group finished by itself');
  expect(text).toContain('0.020  =  board lsc-6  # From here on the board is LSC-6');
  expect(text).toContain('0.020  <  55 55 02 07  # Group was stopped');
  const { recording } = readRecording(text);
  expect(recording?.header).toMatchObject({ board: 'openarm-new', port: 'COM3' });
  expect(recording?.entries).toHaveLength(3);
});
