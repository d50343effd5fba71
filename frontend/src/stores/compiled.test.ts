import { describe, expect, test } from 'vitest';
import { insertFrame } from '#shared/actions/group/groupEdits.ts';
import { obstacles } from './compiled.ts';
import { createDesk } from './deskUnderTest.ts';

const frame = (position: number, easing: 'linear' | 'inOut' = 'linear') => ({
  ...{ durationMs: 800, easing },
  targets: [{ servo: 1, position }],
});

async function openDesk() {
  const desk = await createDesk();
  const state = () => desk.compiled.store.getState();
  const add = (position: number, easing?: 'linear' | 'inOut') =>
    desk.document.edit(
      () => 'add',
      (group) => insertFrame(group, group.frames.length, frame(position, easing)),
    );
  return { ...desk, state, add };
}

describe('the group as the board gets it', () => {
  test('is worked out when the last change is a while ago, once', async () => {
    const { add, state, clock } = await openDesk();
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

  test('is not worked out within a gesture', async () => {
    const { document, state, clock, add } = await openDesk();
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

  test('is there at once for whoever sends it', async () => {
    const { add, compiled, state } = await openDesk();
    add(1000);
    expect(compiled.now().report.frameCount).toBe(1);
    expect(state().isFresh).toBe(true);
    expect(compiled.now()).toBe(compiled.now());
  });

  test('needs fewer frames where a larger error may be', async () => {
    const { add, compiled, clock, state } = await openDesk();
    add(1000);
    add(2000, 'inOut');
    const exact = compiled.now().frames.length;
    compiled.setMaxError(60);
    await clock.advance(300);
    expect(state().latest.frames.length).toBeLessThan(exact);
    expect(state().latest.report.worst?.units).toBeGreaterThan(5);
  });

  test('goes back to fresh when a change is undone', async () => {
    const { add, document, state, clock } = await openDesk();
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
    const { document, compiled } = await openDesk();
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
    const { report } = compiled.now();
    expect(report.problems.map(({ kind }) => kind)).toEqual(['tooFast']);
    expect(obstacles(report, 'board')).toEqual([]);
  });
});
