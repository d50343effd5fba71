import { expect, test } from 'vitest';
import { words } from '../../../i18n/whole.ts';
import { summaryText } from './ThisBoard.tsx';

const SILENT = [{ kind: 'silent', question: 'readBattery' }] as const;

test('silence on a serial port may be a board that answers nothing, on its own USB cable it is a board without power', () => {
  expect(summaryText(SILENT, false)).toBe(words.identity.summaries.silent);
  expect(summaryText(SILENT, true)).toBe(words.identity.summaries.silentOnOwnCable);
});

test('what was heard goes before the cable', () => {
  const noise = [...SILENT, { kind: 'noise', byteCount: 3 }] as const;
  expect(summaryText(noise, true)).toBe(words.identity.summaries.noise);
});
