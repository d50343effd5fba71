// Words about playing the group, from the page and on the board.

import { formatWhole } from './numbers.ts';

export const playWords = {
  late: (frames: number, ms: number): string =>
    `This page was busy while it played: ${frames === 1 ? 'a frame' : `${formatWhole(frames)} frames`} began late, by up to ${formatWhole(ms)} ms. None was left out.`,
  skipped: (frames: number): string =>
    `${frames === 1 ? 'A frame was' : `${formatWhole(frames)} frames were`} left out: the link was busy.`,
};
