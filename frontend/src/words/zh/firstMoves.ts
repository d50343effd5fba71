// Words of first moves: who starts next, and the pose a board was last seen in, in Chinese.

import type { Words } from '../en/whole.ts';
import { formatCount, formatList } from './numbers.ts';
import { MOST_NAMED } from '../numbers.ts';

export const firstMoveWords: Words['firstMoves'] = {
  waiting: (servos) =>
    `正在逐个缓慢启动，还未启动：${servos.length > MOST_NAMED ? `${formatCount(servos.length)}个` : `${formatList(servos)}号`}舵机。`,
  guess: '上次位置',
  guessed: (position) => `${position}?`,
  guessedValue: (position) => `未知；上次位置${position}。第一次移动很慢。`,
  goToGuess: '回到上次的姿势',
  goToGuessHint: '舵机逐个缓慢移动到本页面上次发给这块控制板的位置',
};
