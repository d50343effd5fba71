import { expect, test } from 'vitest';
import { recordingPen } from '../../picture/penUnderTest.ts';
import { editServoView } from '../../stores.ts';
import { paint } from './paint.ts';
import { sceneOf } from './scene.ts';
import { sizesOf } from './rows.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import fc from 'fast-check';
import { marksWithin, markStep } from './paintHeads.ts';

/** So wide is what is left of a key where there are many. */
const TICK_PX = 2;

test('keys that are crowded are as pale as their row: all of them where it is muted', async () => {
  const { stores, context } = await createTestTimeline();
  stores.timeline.setState({ time: { fromMs: 0, msPerPx: 100 } });
  editServoView(stores, (view) => ({ ...view, muted: [1] }));
  const ticks: { y: number; alpha: number }[] = [];
  const ctx: Record<string, unknown> = {
    globalAlpha: 1,
    fillRect(_: number, y: number, width: number) {
      if (width === TICK_PX) ticks.push({ y, alpha: Number(ctx.globalAlpha) });
    },
    measureText: () => ({ width: 10 }),
  };
  const canvas = new Proxy(ctx, { get: (own, name: string) => own[name] ?? (() => undefined) });
  const scene = sceneOf(context(), sizesOf(false, { isTall: false, large: null }));
  paint(
    {
      ctx: canvas as unknown as CanvasRenderingContext2D,
      scene,
      look: recordingPen({ width: 800, height: 400 }).pen.look,
    },
    null,
  );
  const alphasOf = (servo: number) => {
    const row = scene.rows.find((one) => one.row.servos[0] === servo);
    const [top, bottom] = [row?.top ?? 0, (row?.top ?? 0) + (row?.height ?? 0)];
    return ticks.filter(({ y }) => y >= top && y < bottom).map(({ alpha }) => alpha);
  };
  expect(alphasOf(1)).toEqual([0.4, 0.4, 0.4]);
  expect(alphasOf(2)).toEqual([1, 1, 1]);
});

test('labels never touch and are never far apart, however far one zooms', () => {
  fc.assert(
    fc.property(fc.double({ min: 0.1, max: 4000, noNaN: true }), (msPerPx) => {
      const [stepMs] = markStep(msPerPx);
      expect(stepMs / msPerPx).toBeGreaterThanOrEqual(72);
      expect(stepMs / msPerPx).toBeLessThan(Math.max(72 * 4, 1.01 / msPerPx));
    }),
  );
});

test('marks stand at round times within what is seen, every fifth one labelled', () => {
  const marks = marksWithin({ fromMs: 900, toMs: 2300 }, 10);
  expect(marks.map(({ atMs }) => atMs)).toEqual([1000, 1200, 1400, 1600, 1800, 2000, 2200]);
  expect(marks.filter(({ isMain }) => isMain).map(({ atMs }) => atMs)).toEqual([1000, 2000]);
});

test('nothing is marked before the beginning', () => {
  expect(marksWithin({ fromMs: -500, toMs: 0 }, 10)).toEqual([{ atMs: 0, isMain: true }]);
});
