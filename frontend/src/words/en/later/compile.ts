// Words about what a group becomes on the board: whether it fits, how far off it is, what keeps it from going there.

import {
  counted,
  formatCount,
  formatDegrees,
  formatMs,
  formatPosition,
  formatRoughly,
  formatSeconds,
} from '../numbers.ts';
import type { PositionUnit } from '../../numbers.ts';
import { compileWords } from '../compile.ts';

export const wholeCompileWords = {
  ...compileWords,
  label: 'On the board',
  error: 'May be off by',
  step: 'change how far off it may be',
  errorField: 'Largest error allowed on the board',
  frames: (count: number, limit: number): string => `${formatCount(count)} of ${counted(limit, 'frame')}`,
  bytes: (bytes: number): string => counted(bytes, 'byte'),
  download: (ms: number): string => `about ${formatRoughly(ms)} to download`,
  exact: 'Exactly as written',
  worst: (units: number, unit: PositionUnit, degrees: number, name: string, atMs: number): string =>
    `At most ${formatPosition(Math.round(units), unit)} (${formatDegrees(degrees, 1)}) off: ${name} at ${formatSeconds(atMs)}`,
  shifted: (ms: number): string => `Keys moved by up to ${formatMs(ms)}: the board counts ticks`,
  stale: 'Being worked out',
  empty: 'Nothing to store yet.',
  problems: 'What does not fit',
  more: (count: number): string => `and ${formatCount(count)} more`,
};
