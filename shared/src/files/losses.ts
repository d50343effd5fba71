// What a format other than ours does not keep of a group, told before saving. Knows formats by name, no bytes.

import type { ActionGroup } from '../group/group.ts';
import { filled } from './filled.ts';
import type { SaveFormat } from './writeGroupFile.ts';

export const LOSS_CODES = ['easings', 'marks', 'about', 'times', 'completed', 'lacking'] as const;
export type LossCode = (typeof LOSS_CODES)[number];

/** What another format does not keep, or has to be given; with the frames it is about, counted from 1. */
export interface Loss {
  readonly code: LossCode;
  readonly frames: readonly number[];
}

/** Told before saving, so that nobody finds out later. */
export function lossesIn(format: SaveFormat, group: ActionGroup): readonly Loss[] {
  if (format === 'json') return [];
  const { frames, markers, robot, tags, times } = group;
  const { completed, lacking } = filled(group);
  const isProgram = format === 'python' || format === 'arduino';
  const found: Readonly<Record<LossCode, boolean | readonly number[]>> = {
    easings: isProgram ? [] : frames.flatMap(({ easing }, index) => (easing === 'linear' ? [] : [index + 1])),
    marks: markers.length > 0 || frames.some(({ note, colour }) => note !== '' || colour !== null),
    about: robot !== '' || tags.length > 0,
    times: times !== 1 && !isProgram,
    completed,
    lacking: isProgram ? [] : lacking,
  };
  return LOSS_CODES.flatMap((code) => {
    const where = found[code];
    if (typeof where === 'boolean') return where ? [{ code, frames: [] }] : [];
    return where.length === 0 ? [] : [{ code, frames: where }];
  });
}
