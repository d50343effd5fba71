import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { fleetRobot } from './samples.ts';
import { CONDITIONS, conditionOf, groupsIn, inOrder, matches, needsPerson, takesMotion } from './robots.ts';
import { commonGroups, slotOf } from './slots.ts';
import { cueState, wishOf } from './cues.ts';

const idsOf = (robots: readonly { readonly id: string }[]): string => robots.map(({ id }) => id).join(' ');

describe('the condition of a robot', () => {
  test.each([
    ['ready', fleetRobot('a')],
    ['driven', fleetRobot('a', { state: { driver: 'Anna' } })],
    ['busy', fleetRobot('a', { state: { running: { slot: 3, name: 'Wave' }, driver: 'Anna' } })],
    ['low', fleetRobot('a', { state: { batteryMv: 6000 } })],
    ['stopped', fleetRobot('a', { state: { latch: true, batteryMv: 6000 } })],
    ['lost', fleetRobot('a', { state: { link: 'lost', latch: true } })],
    ['silent', fleetRobot('a', { presence: 'silent' })],
    ['silent', fleetRobot('a', { state: null })],
    ['cloned', fleetRobot('a', { presence: 'cloned', state: { latch: true } })],
  ])('is %s', (condition, robot) => {
    expect(conditionOf(robot)).toBe(condition);
  });

  test('a battery that was never read, or reads zero, is not low', () => {
    expect(conditionOf(fleetRobot('a', { state: { batteryMv: null } }))).toBe('ready');
    expect(conditionOf(fleetRobot('a', { state: { batteryMv: 0 } }))).toBe('ready');
  });

  test('only a robot that is linked and not stopped takes motion', () => {
    const able = CONDITIONS.filter((condition) =>
      [
        fleetRobot('a'),
        fleetRobot('a', { state: { driver: 'Anna' } }),
        fleetRobot('a', { state: { latch: true } }),
        fleetRobot('a', { state: { link: 'lost' } }),
        fleetRobot('a', { presence: 'silent' }),
        fleetRobot('a', { presence: 'cloned' }),
      ].some((robot) => conditionOf(robot) === condition && takesMotion(robot)),
    );
    expect(able).toEqual(['driven', 'ready']);
  });
});

describe('the order', () => {
  const robots = [
    fleetRobot('arm-10'),
    fleetRobot('arm-2', { state: { batteryMv: 7200 } }),
    fleetRobot('arm-3', { state: { latch: true } }),
    fleetRobot('arm-4', { presence: 'silent', state: { batteryMv: 7100 } }),
    fleetRobot('arm-1', { presence: 'cloned' }),
  ];

  test('who needs a person comes first, the most urgent before', () => {
    expect(idsOf(inOrder(robots, 'urgency'))).toBe('arm-1 arm-4 arm-3 arm-2 arm-10');
  });

  test('names are in the order in which people count', () => {
    expect(idsOf(inOrder(robots, 'name'))).toBe('arm-1 arm-2 arm-3 arm-4 arm-10');
  });

  test('the lowest battery comes first, unknown ones last', () => {
    const unread = fleetRobot('arm-0', { state: { batteryMv: null } });
    expect(idsOf(inOrder([unread, ...robots], 'battery'))).toBe('arm-4 arm-2 arm-1 arm-3 arm-10 arm-0');
  });

  test('no order loses or doubles a robot, and those who need a person are in front', () => {
    const robot = fc.record({
      id: fc.string({ minLength: 1, maxLength: 4 }),
      latch: fc.boolean(),
      presence: fc.constantFrom('present' as const, 'silent' as const, 'cloned' as const),
      batteryMv: fc.option(fc.integer({ min: 0, max: 9000 })),
    });
    fc.assert(
      fc.property(fc.uniqueArray(robot, { selector: ({ id }) => id, maxLength: 12 }), (drawn) => {
        const all = drawn.map(({ id, presence, ...state }) => fleetRobot(id, { presence, state }));
        for (const order of ['urgency', 'name', 'battery'] as const) {
          expect(new Set(inOrder(all, order))).toEqual(new Set(all));
        }
        const needs = inOrder(all, 'urgency').map(needsPerson);
        expect(needs).toEqual(needs.toSorted((one, other) => Number(other) - Number(one)));
      }),
    );
  });
});

describe('search and groups', () => {
  const robot = fleetRobot('arm-7', { name: 'Blue arm', groups: ['Table 2'], board: 'xarm' });

  test.each([
    ['', true],
    ['blue', true],
    ['table ARM', true],
    ['xarm', true],
    ['red', false],
  ])('“%s” finds it: %s', (search, isFound) => {
    expect(matches(robot, search)).toBe(isFound);
  });

  test('groups of robots are listed once each', () => {
    const other = fleetRobot('b', { groups: ['Table 10', 'Table 2'] });
    expect(groupsIn([robot, other])).toEqual(['Table 2', 'Table 10']);
  });
});

describe('action groups in common', () => {
  const one = fleetRobot('a', {
    slots: [
      { slot: 5, name: 'Wave' },
      { slot: 3, name: 'Wave' },
      { slot: 4, name: 'Bow' },
    ],
  });
  const other = fleetRobot('b', {
    slots: [
      { slot: 9, name: 'Wave' },
      { slot: 1, name: '' },
    ],
  });

  test('are those with the same name on every robot, each in its own slot', () => {
    expect(commonGroups([one, other])).toEqual(['Wave']);
    expect([slotOf(one, 'Wave'), slotOf(other, 'Wave')]).toEqual([3, 9]);
  });

  test('there are none of no robots', () => {
    expect(commonGroups([])).toEqual([]);
  });
});

describe('a cue', () => {
  const wave = { name: 'Wave', robots: 'Table 1', times: 2, stopsOthers: true };
  const slots = [{ slot: 3, name: 'Wave' }];
  const robots = [
    fleetRobot('a', { groups: ['Table 1'], slots }),
    fleetRobot('b', { groups: ['Table 1'], slots: [{ slot: 9, name: 'Wave' }] }),
    fleetRobot('c', { groups: ['Table 1'] }),
    fleetRobot('d', { groups: ['Table 1'], slots, state: { latch: true } }),
    fleetRobot('e', { groups: ['Table 2'], slots }),
  ];

  test('starts those that are ready together, each from its own slot; the others are missing', () => {
    const { missing } = cueState(wave, robots);
    expect(idsOf(missing)).toBe('c d');
    expect(wishOf(wave, robots)).toEqual({
      ...{ name: 'Wave', times: 2, together: true, stopsOthers: true },
      runs: [
        { robot: 'a', slot: 3 },
        { robot: 'b', slot: 9 },
      ],
    });
  });

  test('without a group of robots is for all, and asks for nothing where none is ready', () => {
    expect(idsOf(cueState({ ...wave, robots: '' }, robots).ready)).toBe('a b e');
    expect(wishOf({ ...wave, robots: 'Table 3' }, robots)).toBeNull();
  });
});
