// Words of first moves: who starts next, and the pose a board was last seen in.

import { counted, formatList } from './numbers.ts';
import { MOST_NAMED } from '../numbers.ts';

export const firstMoveWords = {
  waiting: (servos: readonly number[]): string =>
    `Starting slowly, one after another. Still to start: ${servos.length > MOST_NAMED ? counted(servos.length, 'servo') : formatList(servos)}.`,
  guess: 'Last known',
  /** In the place of a figure. */
  guessed: (position: string): string => `${position}?`,
  guessedValue: (position: string): string => `Unknown; last known ${position}. The first move is slow.`,
  goToGuess: 'Go to the last known pose',
  goToGuessHint: 'Slowly, one servo after another, to where this board’s servos were last sent from here',
};
