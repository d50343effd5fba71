// Things that happen to a board at a chosen time, each once. Knows times, not what happens.

import type { Source } from './agenda.ts';

export interface Happening {
  readonly atMs: number;
  readonly happen: () => void;
}

export function createSchedule(happenings: readonly Happening[]): Source {
  const ahead = happenings.filter(({ atMs }) => atMs < Infinity).sort((a, b) => a.atMs - b.atMs);
  return {
    dueMs: () => ahead[0]?.atMs ?? Infinity,
    fire: () => ahead.shift()?.happen(),
  };
}
