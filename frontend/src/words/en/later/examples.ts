// Words about groups to begin with, and about recording one by hand.

import type { ExampleId } from '#shared/actions/examples/examples.ts';
import { counted, formatCount, formatSeconds } from '../numbers.ts';
import { recordWords } from '../record.ts';

const names: Readonly<Record<ExampleId, string>> = {
  wave: 'Wave',
  bow: 'Bow',
  pickAndPlace: 'Pick and place',
  lookAround: 'Look around',
  fist: 'Fist and open',
  countToFive: 'Count to five',
  point: 'Point',
  squat: 'Squat',
  cheer: 'Cheer',
  tripodGait: 'Tripod gait',
  rise: 'Rise and sink',
  ripple: 'Ripple',
  sweep: 'Sweep',
};

export const exampleWords = {
  open: 'Examples',
  begin: 'Begin with an example',
  title: 'Examples for this robot',
  intro: 'An example takes the place of the group on this page. Undo brings the group back. Nothing moves.',
  name: (id: ExampleId): string => names[id],
  about: (frameCount: number, durationMs: number): string =>
    `${counted(frameCount, 'frame')}, ${formatSeconds(durationMs)}`,
  step: (name: string): string => `example ${name}`,
};

export const wholeRecordWords = {
  ...recordWords,
  record: 'Record',
  recordHint: 'Records what sliders and pad do, until you end it',
  end: (ms: number): string => `End recording, ${formatSeconds(ms)}`,
  takeThat: 'Keep last 2 minutes',
  takeThatHint: 'The motion of the last two minutes becomes a group. Key: T',
  keeps: {
    armed: (count: number, all: number): string =>
      `Records what is armed, ${counted(count, 'servo')} of ${formatCount(all)}`,
    selected: (count: number, all: number): string =>
      `Records what is selected, ${counted(count, 'servo')} of ${formatCount(all)}; rows can be armed instead`,
    all: (): string => 'Records every servo; rows can be armed for less',
  },
  error: 'May be off by',
  errorField: 'How far the keys may be off what was recorded',
  result: (ms: number, samples: number, keys: number): string =>
    `${formatSeconds(ms)}; ${counted(samples, 'position becomes', 'positions become')} ${counted(keys, 'key')}`,
  replace: 'Make it the group',
  append: 'Add to the end',
  name: (time: string): string => `Take ${time}`,
  steps: { replace: 'recorded motion', append: 'add recorded motion' },
};
