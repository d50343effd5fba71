// Words about playing the group, from the page and on the board.

import { formatNames, formatPercent, formatSeconds, formatWhole } from '../numbers.ts';
import { timesWords } from '../times.ts';
import { playWords } from '../play.ts';

export const wholePlayWords = {
  ...playWords,
  tools: 'Play the group',
  play: (times: number): string => (times === 1 ? 'Play' : `Play ${timesWords(times)}`),
  playFrom: (atMs: number): string => `Play from ${formatSeconds(atMs)}`,
  preview: 'Preview',
  previewHint: 'Plays on the drawing alone. Moves nothing. Shift+Space in the timeline',
  pause: 'Pause',
  end: 'End',
  cancel: 'Cancel download',
  onBoard: 'Run on board',
  onBoardHint: (slot: number): string => `The board plays slot ${formatWhole(slot)} by itself`,
  onBoardDownloads: (slot: number, isOlder: boolean): string =>
    isOlder
      ? `The copy in slot ${formatWhole(slot)} is older: downloads this group first, then runs it`
      : `Downloads to slot ${formatWhole(slot)} first, then runs it`,
  silent: (names: readonly string[]): string =>
    `Not sent from here: ${formatNames(names)}. The board plays every row.`,
  back: 'A frame back',
  forth: 'A frame on',
  loop: 'Loop',
  live: 'Robot follows',
  speedField: 'Speed of playing from the page, in percent',
  percent: '%',
  phase: {
    leading: 'Going gently to the first pose',
    returning: 'The loop ends far from where it begins: going back gently',
    playing: (share: number): string => `Playing, ${formatPercent(share)} of the speed`,
    storing: 'The board gets this group first',
    running: 'The board plays it',
    previewing: 'Only on the drawing, nothing moves',
  },
};
