// The table of bindings: who has a row of his own.

import { describe, expect, test } from 'vitest';
import { mappingFromText, mappingToText, readyMapping } from '#shared/profile/mapping.ts';
import { conflicts } from '#shared/profile/mappingStep.ts';
import { EMPTY_BOOK } from '#shared/profile/pose.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotNames, servoLabel } from '../../i18n/sentences.ts';
import { choosingTip, readyBindings, rowsOf } from './rows.ts';

const ARM = readyRobot('arm', 'doc', robotNames('arm'));
const HEXAPOD = readyRobot('hexapod18', 'lsc-24', robotNames('hexapod18'));

test('servos that are called alike on two limbs have a row each, and the limb in its title', () => {
  const rows = rowsOf(readyMapping(HEXAPOD), HEXAPOD, EMPTY_BOOK);
  const titles = rows.map(({ title }) => title);
  expect(titles.slice(0, HEXAPOD.servos.length)).toEqual(HEXAPOD.servos.map(servoLabel));
  expect(new Set(titles).size).toBe(titles.length);
});

describe('joints or tip', () => {
  test('each choice has its own bindings, and both are stored', () => {
    const joints = readyMapping(ARM);
    const tip = choosingTip(joints, ARM, true);
    expect(tip.bindings).toEqual(readyBindings(ARM, true));
    const changed = { ...tip, bindings: tip.bindings.slice(1) };
    const back = choosingTip(changed, ARM, false);
    expect(back.bindings).toEqual(joints.bindings);
    expect(choosingTip(back, ARM, true)).toEqual(changed);
    expect(mappingFromText(mappingToText(back))).toEqual({ value: back });
  });

  test('the ready bindings of the tip do nothing twice, and stop as ever', () => {
    const bindings = readyBindings(ARM, true);
    expect(conflicts({ ...readyMapping(ARM), bindings })).toEqual([]);
    expect(bindings.some(({ action }) => action.kind === 'stop')).toBe(true);
  });
});
