import { describe, expect, test } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import { insertFrame, setMeta } from '#shared/group/groupEdits.ts';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { emptyGroup, groupFromText, groupToText } from '#shared/group/group.ts';
import { createCompiled, obstacles } from './compiled.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { compileSource, type Source } from './compileSource.ts';

const frame = (position: number, easing: 'linear' | 'inOut' = 'linear') => ({
  ...{ durationMs: 800, easing },
  targets: [{ servo: 1, position }],
});

async function openTestPage() {
  const page = await createTestPage();
  const state = () => page.compiled.store.getState();
  const add = (position: number, easing?: 'linear' | 'inOut') =>
    page.document.edit(
      () => 'add',
      (group) => insertFrame(group, group.frames.length, frame(position, easing)),
    );
  const setMax = (maxErrorUnits: number) =>
    page.document.edit(
      () => 'error',
      (group) => setMeta(group, { maxErrorUnits }),
    );
  return { ...page, state, add, setMax };
}

describe('the group as the board gets it', () => {
  test('is worked out when the last change is a while ago, once', async () => {
    const { add, state, clock } = await openTestPage();
    const before = state().latest;
    add(1000);
    await clock.advance(200);
    add(1500);
    await clock.advance(200);
    expect(state()).toMatchObject({ isFresh: false });
    expect(state().latest).toBe(before);
    await clock.advance(100);
    expect(state().isFresh).toBe(true);
    expect(state().latest.report.frameCount).toBe(2);
  });

  test('made only of blocks is worked out from the start of a visit', async () => {
    const made = [1000, 1500].reduce(
      (group, position) => insertFrame(group, group.frames.length, frame(position)),
      emptyGroup('Wave', 'us'),
    );
    const blocks = makeBlock(
      made,
      [1, 2].map((frameId) => ({ frameId, servo: 1 })),
      'All',
    )!;
    expect(blocks.frames).toEqual([]);
    const { compiled, clock } = await createTestPage(new Map([['servodeck.group', groupToText(blocks)]]));
    expect(compiled.store.getState().isFresh).toBe(false);
    expect(compiled.now(compileSource).frames.length).toBeGreaterThan(0);
    await clock.advance(300);
    expect(compiled.store.getState().latest.report.frameCount).toBeGreaterThan(0);
  });

  test('is not worked out within a gesture', async () => {
    const { document, state, clock, add } = await openTestPage();
    add(1000);
    await clock.advance(300);
    document.begin(() => 'drag');
    document.preview((group) => insertFrame(group, 1, frame(1500)));
    await clock.advance(5000);
    expect(state().latest.report.frameCount).toBe(1);
    document.commit();
    await clock.advance(300);
    expect(state().latest.report.frameCount).toBe(2);
  });

  test('is there at once where it is sent', async () => {
    const { add, compiled, state } = await openTestPage();
    add(1000);
    expect(compiled.now(compileSource).report.frameCount).toBe(1);
    expect(state().isFresh).toBe(true);
    expect(compiled.now(compileSource)).toBe(compiled.now(compileSource));
  });

  test('worked out beside the page: the last one stands until the next is there, one at a time, the newest wins', async () => {
    const { document, device, robots, clock, add } = await openTestPage();
    const orders: { readonly source: Source; answer(): void; fail(): void }[] = [];
    const { store, now } = createCompiled({
      ...{ document, device, robots, clock },
      compileElsewhere: (source) =>
        new Promise((resolve, reject) =>
          orders.push({
            source,
            answer: () => resolve(compileSource(source)),
            fail: () => reject(new Error()),
          }),
        ),
    });
    const frames = (): readonly [number, boolean] => {
      const { latest, isFresh } = store.getState();
      return [latest.report.frameCount, isFresh];
    };
    add(1000);
    await clock.advance(300);
    add(1500);
    await clock.advance(1000);
    expect(orders).toHaveLength(1);
    expect(frames()).toEqual([0, false]);
    orders[0]!.answer();
    await clock.advance(300);
    expect(frames()).toEqual([0, false]);
    expect(orders[1]!.source.group.frames).toHaveLength(2);
    orders[1]!.answer();
    await clock.advance(0);
    expect(frames()).toEqual([2, true]);

    add(1800);
    await clock.advance(300);
    const whole = now(compileSource);
    orders[2]!.answer();
    await clock.advance(300);
    expect(store.getState().latest).toBe(whole);

    add(1200);
    await clock.advance(300);
    orders[3]!.fail();
    await eventually(() => expect(frames()).toEqual([4, true]));
  });

  test('needs fewer frames where a larger error may be', async () => {
    const { add, compiled, clock, state, setMax } = await openTestPage();
    add(1000);
    add(2000, 'inOut');
    const exact = compiled.now(compileSource).frames.length;
    setMax(60);
    await clock.advance(300);
    expect(state().latest.frames.length).toBeLessThan(exact);
    expect(state().latest.report.worst?.units).toBeGreaterThan(5);
  });

  test('how far off it may be is the group’s: undone, kept and of no other one', async () => {
    const { add, compiled, document, device, robots, setMax } = await openTestPage();
    add(1000);
    const { present: before } = document.store.getState();
    setMax(60);
    expect(compiled.now(compileSource).source.maxErrorUnits).toBe(60);
    const on = { family: device.store.getState().family, robot: robots.current().robot };
    expect(compiled.of(before, on, compileSource).source.maxErrorUnits).toBe(5);
    const read = groupFromText(groupToText(document.store.getState().present));
    expect(read).toMatchObject({ value: { maxErrorUnits: 60 } });
    document.undo();
    expect(compiled.now(compileSource).source.maxErrorUnits).toBe(5);
  });

  test('of another group is worked out once for each robot, however often it is asked for', async () => {
    const { compiled, document, device, robots } = await openTestPage();
    const { present: group } = document.store.getState();
    const on = { family: device.store.getState().family, robot: robots.current().robot };
    const first = compiled.of(group, on, compileSource);
    expect(compiled.of(group, { ...on }, compileSource)).toBe(first);
    expect(compiled.of(group, { ...on, robot: { ...on.robot } }, compileSource)).not.toBe(first);
  });

  test('goes back to fresh when a change is undone', async () => {
    const { add, document, state, clock } = await openTestPage();
    add(1000);
    await clock.advance(300);
    const { latest } = state();
    add(1500);
    document.undo();
    expect(state()).toMatchObject({ isFresh: true });
    await clock.advance(300);
    expect(state().latest).toBe(latest);
  });

  test('a servo that comes late is said and keeps nothing from being sent', async () => {
    const { document, compiled } = await openTestPage();
    document.edit(
      () => 'fast',
      (group) => ({
        ...[500, 2500].reduce(
          (sum, position) =>
            insertFrame(sum, sum.frames.length, { durationMs: 100, targets: [{ servo: 1, position }] }),
          group,
        ),
      }),
    );
    const { report } = compiled.now(compileSource);
    expect(report.problems.map(({ kind }) => kind)).toEqual(['tooFast']);
    expect(obstacles(report, 'board')).toEqual([]);
  });
});
