// Words of the action group being written: its frames, what is done to them, and the steps that come of it.

import type { PositionUnit } from '../../numbers.ts';
import { counted, formatList, formatMs, formatSeconds, formatWhole, unitSymbol } from '../numbers.ts';
import { actionWords } from '../actions.ts';

export const wholeActionWords = {
  ...actionWords,
  title: 'Action group',
  name: 'Name of the group',
  frames: 'Frames',
  empty: 'No frames yet',
  emptyHint: 'Pose the robot with the sliders, then capture the pose. Two or three poses make a motion.',
  captureHint: 'Adds the commanded or reported pose after the selected frame',
  frame: (number: number): string => `Frame ${formatWhole(number)}`,
  frameAbout: (number: number, durationMs: number, changed: readonly number[]): string => {
    const moved =
      changed.length === 0
        ? 'moves nothing'
        : `moves ${changed.length === 1 ? 'servo' : 'servos'} ${formatList(changed)}`;
    return `Frame ${formatWhole(number)}, ${formatMs(durationMs)}, ${moved}`;
  },
  playingFrame: 'Playing',
  time: (number: number): string => `Time of frame ${formatWhole(number)} in milliseconds`,
  tools: 'Change the selected frame',
  select: 'Select a frame to change it.',
  several: (count: number): string => `${counted(count, 'frame')} selected`,
  load: 'Go to pose',
  update: 'Update pose',
  duplicate: 'Duplicate',
  cut: 'Cut frames',
  copy: 'Copy frames',
  paste: 'Paste frames',
  adds: 'Several',
  copied: (count: number): string => `${counted(count, 'frame')} copied`,
  nothingToPaste: 'Copy some frames or keys first.',
  insert: { before: 'Insert the pose before', after: 'Insert the pose after' },
  delete: 'Delete',
  earlier: 'Move earlier',
  later: 'Move later',
  total: (count: number, ms: number): string => `${counted(count, 'frame')}, ${formatSeconds(ms)}`,
  /** Numbers of the same frames; several stand together afterwards. */
  moved: (from: readonly number[], to: readonly number[]): string =>
    to.length === 1
      ? `Frame ${formatWhole(from[0] ?? 0)} is now frame ${formatWhole(to[0] ?? 0)}`
      : `${counted(to.length, 'frame')} are now frames ${formatWhole(to[0] ?? 0)} to ${formatWhole(to.at(-1) ?? 0)}`,
  otherUnit: (unit: PositionUnit): string => `Made for another board, which counts in ${unitSymbol(unit)}.`,
  otherBoard: 'Made for another board. Convert?',
  convert: 'Convert',
  convertHint: (to: PositionUnit): string =>
    to === 'steps'
      ? 'To steps: (µs − 500) ÷ 2, rounded. Can be undone'
      : 'To µs: steps × 2 + 500. Can be undone',
  notConverted: 'Not converted: a position below 500 µs has no counterpart in steps.',
};
