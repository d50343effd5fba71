import { describe, expect, test } from 'vitest';
import { editServoView } from '../../stores.ts';
import { tracksOf } from '#shared/group/tracks.ts';
import { curveHandles, type CurveHandle } from './curveHandles.ts';
import { answer } from './questions.ts';
import { sizesOf, type Spot } from './rows.ts';
import { sceneOf } from './scene.ts';
import { createTestTimeline } from './timelineUnderTest.ts';

const LARGE = { servo: 1, min: 1000, max: 1600 };

/** Servo 1 is open large: 1000, 1200 and 1400 at 500, 1000 and 1500 ms. */
async function createGraph() {
  const timeline = await createTestTimeline();
  const sizes = sizesOf(false, { isTall: false, large: LARGE });
  timeline.stores.timeline.setState({ large: LARGE });
  const handles = () => curveHandles(sceneOf(timeline.context(), sizes));
  const spotOf = (toFrame: number, end: CurveHandle['end']): Spot => {
    const handle = handles().find((one) => one.to.frameId === toFrame && one.end === end);
    if (handle === undefined) throw new Error(`no handle at the ${end} of the way to frame ${toFrame}`);
    return handle.spot;
  };
  const easings = (servo: number) =>
    tracksOf(timeline.group())
      .get(servo)
      ?.keys.map(({ easing }) => easing);
  const drag = (spot: Spot, x: number, y: number, held = {}) => {
    const gesture = timeline.press(spot, held, false, sizes);
    gesture.by(x, y, { alt: true, ...held });
    return gesture;
  };
  return { ...timeline, sizes, handles, spotOf, easings, drag };
}

describe('the handles of a curve', () => {
  test('stand before and behind each selected key of the row that is open large, and nowhere else', async () => {
    const { handles, select } = await createGraph();
    expect(handles()).toEqual([]);
    select([2, 1], [2, 2]);
    expect(handles().map(({ to, end }) => [to.servo, to.frameId, end])).toEqual([
      [1, 2, 'end'],
      [1, 3, 'begin'],
    ]);
    select([1, 1]);
    expect(handles().map(({ to, end }) => [to.frameId, end])).toEqual([[2, 'begin']]);
  });

  test('dragged bend the way of that servo alone, in one step that undo takes back', async () => {
    const { select, spotOf, drag, easings, steps, stores } = await createGraph();
    select([2, 1]);
    const before = steps();
    const gesture = drag(spotOf(2, 'end'), -10, 0);
    gesture.by(-10, -40, { alt: true });
    gesture.end(false);
    const [, curve, straight] = easings(1) ?? [];
    expect(curve?.slice(0, 3)).toEqual([1 / 3, 1 / 3, 0.467]);
    expect(Number(curve?.[3])).toBeGreaterThan(1);
    expect(straight).toBe('linear');
    expect(easings(2)).toEqual(['linear', 'linear', 'linear']);
    expect(steps()).toBe(before + 1);
    stores.document.undo();
    expect(easings(1)).toEqual(['linear', 'linear', 'linear']);
  });

  test('with Ctrl keep the motion through the key at one speed', async () => {
    const { select, spotOf, drag, easings, group } = await createGraph();
    select([2, 1]);
    drag(spotOf(2, 'end'), 0, 30, { ctrl: true }).end(false);
    const [, into, out] = easings(1) ?? [];
    expect(typeof into).toBe('object');
    expect(typeof out).toBe('object');
    const track = tracksOf(group()).get(1)!;
    const [one, other] = [Number(into?.[3]), Number(out?.[1])];
    const [x2, x1] = [Number(into?.[2]), Number(out?.[0])];
    expect((1 - one) / (1 - x2)).toBeCloseTo(other / x1, 1);
    expect(track.keys.map(({ position }) => position)).toEqual([1000, 1200, 1400]);
  });

  test('come to rest level with a key, but not with Alt', async () => {
    const { select, spotOf, spotIn, sizes, press, easings } = await createGraph();
    select([2, 1]);
    const [spot, key] = [spotOf(2, 'end'), spotIn(1, 2, sizes)];
    const gesture = press(spot, {}, false, sizes);
    gesture.by(0, key.y - spot.y + 3, {});
    expect(easings(1)?.[1]?.[3]).toBe(1);
    gesture.by(0, key.y - spot.y + 3, { alt: true });
    expect(easings(1)?.[1]?.[3]).not.toBe(1);
    gesture.cancel();
    expect(easings(1)).toEqual(['linear', 'linear', 'linear']);
  });

  test('stay where the row is locked', async () => {
    const { select, spotOf, drag, easings, stores } = await createGraph();
    select([2, 1]);
    const spot = spotOf(2, 'end');
    editServoView(stores, (view) => ({ ...view, locked: [1] }));
    const gesture = drag(spot, 0, -40);
    expect(gesture.status).toBe('locked');
    expect(easings(1)).toEqual(['linear', 'linear', 'linear']);
  });
});

describe('a curve by its numbers', () => {
  test('is set on all selected keys, written as CSS has it or with spaces alone', async () => {
    const { select, context, easings, noticeTexts } = await createGraph();
    select([2, 1], [3, 2]);
    answer(context(), 'curve', 'cubic-bezier(0.34, 1.56, 0.64, 1)');
    expect([easings(1)?.[1], easings(2)?.[2]]).toEqual([
      [0.34, 1.56, 0.64, 1],
      [0.34, 1.56, 0.64, 1],
    ]);
    answer(context(), 'curve', '0.2 −0.5 1 1');
    expect(easings(1)?.[1]).toEqual([0.2, -0.5, 1, 1]);
    for (const wrong of ['', '1 2 3', '1.2 0 1 1', '0 9 1 1', 'a b c d', '0 0 1 1 1'])
      answer(context(), 'curve', wrong);
    expect(easings(1)?.[1]).toEqual([0.2, -0.5, 1, 1]);
    expect(noticeTexts().at(-1)).toBe('A curve is four numbers, x1 y1 x2 y2: x from 0 to 1, y from -2 to 3.');
  });

  test('smoothed through by a key, and read out', async () => {
    const { select, key, easings, context } = await createGraph();
    select([2, 1]);
    key('E', { shiftKey: true });
    expect(easings(1)?.[1]?.slice(2)).toEqual([0.667, 0.667]);
    key('e');
    expect(context().state.question).toBe('curve');
  });
});
