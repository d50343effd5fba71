import { describe, expect, test } from 'vitest';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { factsOf, slotOffered, wishesFor, type Picked } from './downloads.ts';
import { fleetGroup, fleetRobot } from './samples.ts';

const arm = fleetRobot('a', { slots: [{ slot: 21, name: 'Wave' }] });
const other = fleetRobot('b', { slots: [{ slot: 23, name: 'Bow' }] });
const hexapod = fleetRobot('c', { board: 'lsc-32' });

const picked = (name: string, slot: number, servos: readonly number[]): Picked => ({
  ...{ id: name, slot },
  group: fleetGroup(name, servos),
});

describe('the slot that is offered', () => {
  test('is the next one that is free on all of the robots, and not of another chosen group', () => {
    expect(slotOffered(fleetGroup('Nod', [1]), [arm, other], [])).toBe(22);
    expect(slotOffered(fleetGroup('Nod', [1]), [arm, other], [22])).toBe(24);
  });

  test('is the one where a robot has the group already, or that the group names', () => {
    expect(slotOffered(fleetGroup('Bow', [1]), [arm, other], [])).toBe(23);
    expect(slotOffered(fleetGroup('Bow', [1], 9), [arm, other], [])).toBe(9);
    expect(slotOffered(fleetGroup('Bow', [1], 9), [arm, other], [9])).toBe(22);
  });

  test('is one that every board has', () => {
    const small = fleetRobot('d', { board: 'xarm' });
    expect(slotOffered(fleetGroup('Nod', [1], 250), [arm, small], [])).not.toBe(250);
  });
});

test('a group made only of blocks is as good as its keys', () => {
  const { group, ...rest } = picked('Wave', 1, [1]);
  const refs = group.frames.map(({ id: frameId }) => ({ frameId, servo: 1 }));
  const blocks = { ...rest, group: makeBlock(group, refs, 'All')! };
  expect(blocks.group.frames).toEqual([]);
  expect(factsOf(blocks, [blocks], [arm])).toMatchObject({ isEmpty: false, refusedBy: [] });
  expect(wishesFor([blocks], [arm])).toHaveLength(1);
});

describe('the wishes', () => {
  const wave = picked('Wave', 1, [1, 2]);
  const crawl = picked('Crawl', 2, [12, 13]);

  test('are one for all robots that take the same frames, with the groups that fit them', () => {
    const wishes = wishesFor([wave, crawl], [arm, other, hexapod]);
    expect(
      wishes.map(({ robots, groups }) => [robots, groups.map(({ slot, name }) => [slot, name])]),
    ).toEqual([
      [['a', 'b'], [[1, 'Wave']]],
      [
        ['c'],
        [
          [1, 'Wave'],
          [2, 'Crawl'],
        ],
      ],
    ]);
    expect(wishes[0]?.groups[0]?.frames[0]).toEqual({ durationMs: 600, positions: { 1: 1300, 2: 1300 } });
  });

  test('give each robot its own trims, within its own limits', () => {
    const limits = (trim: number) => [{ servo: 1, name: 'Base', min: 900 + trim, max: 2100 + trim, trim }];
    const [trimmed, narrow] = [
      fleetRobot('d', { limits: limits(20) }),
      fleetRobot('e', { limits: [{ ...limits(0)[0]!, max: 1200 }] }),
    ];
    const wishes = wishesFor([wave], [arm, trimmed, narrow]);
    expect(wishes.map(({ robots, groups }) => [robots, groups[0]?.frames[0]?.positions])).toEqual([
      [['a'], { 1: 1300, 2: 1300 }],
      [['d'], { 1: 1320, 2: 1300 }],
    ]);
  });

  test('leave out a robot that no group fits', () => {
    expect(wishesFor([crawl], [arm])).toEqual([]);
  });
});

describe('what is said of a group before it is sent', () => {
  test('names the boards that it does not fit, and the robots where it replaces another group', () => {
    const crawl = picked('Crawl', 2, [12, 13]);
    expect(factsOf(crawl, [crawl], [arm, other, hexapod])).toMatchObject({ replacesOn: [] });
    expect(factsOf(crawl, [crawl], [arm, other, hexapod]).refusedBy).toHaveLength(1);
    const nod = picked('Nod', 23, [1]);
    expect(factsOf(nod, [nod], [arm, other, hexapod])).toMatchObject({ refusedBy: [], replacesOn: ['b'] });
    const bow = picked('Bow', 23, [1]);
    expect(factsOf(bow, [bow], [other]).replacesOn).toEqual([]);
  });

  test('says that it has no frame, and that another one has its slot', () => {
    const none = picked('None', 23, []);
    const nod = picked('Nod', 23, [1]);
    expect(factsOf(none, [none, nod], [arm])).toMatchObject({
      isEmpty: true,
      isSlotTwice: true,
      refusedBy: [],
    });
  });
});
