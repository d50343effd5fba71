// The table of bindings: who has a row of his own.

import { expect, test } from 'vitest';
import { readyMapping } from '#shared/profile/mapping.ts';
import { EMPTY_BOOK } from '#shared/profile/pose.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotNames, servoLabel } from '../../i18n/sentences.ts';
import { rowsOf } from './rows.ts';

const HEXAPOD = readyRobot('hexapod18', 'lsc-24', robotNames('hexapod18'));

test('servos that are called alike on two limbs have a row each, and the limb in its title', () => {
  const rows = rowsOf(readyMapping(HEXAPOD), HEXAPOD, EMPTY_BOOK);
  const titles = rows.map(({ title }) => title);
  expect(titles.slice(0, HEXAPOD.servos.length)).toEqual(HEXAPOD.servos.map(servoLabel));
  expect(new Set(titles).size).toBe(titles.length);
});
