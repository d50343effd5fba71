// The stores of a timeline with a small group, for tests: three frames of 500 ms, servos 1 and 2 keyed in each, servo 3 in the
// first and the last. The tracks show 0.1 s in 10 px, from 0 on.

import { insertFrame } from '#shared/group/groupEdits.ts';
import { emptyGroup, type ActionGroup } from '#shared/group/group.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { createDocument } from '../../groupDocument.ts';
import { createTimeline, keySet, selectedKeys } from './timeline.ts';
import { createView } from '../../view.ts';
import { contextOf, select } from './context.ts';
import type { Held } from './gesture.ts';
import { gestureOf } from './gestures.ts';
import { sceneOf } from './scene.ts';
import { keyY, type Sizes, sizesOf } from './rows.ts';
import { pressInTimeline } from './timelineActions.ts';
import { xOf } from './timeScale.ts';

const at = (...positions: readonly (number | null)[]) =>
  positions.flatMap((position, index) => (position === null ? [] : [{ servo: index + 1, position }]));

const FRAMES = [at(1000, 1500, 2000), at(1200, 1500, null), at(1400, 1600, 1000)];

export function smallGroup(): ActionGroup {
  return FRAMES.reduce(
    (group, targets) => insertFrame(group, group.frames.length, { durationMs: 500, targets }),
    emptyGroup('Small', 'us'),
  );
}

const SIZES = sizesOf(false, { isTall: false, large: null });
const NOTHING_HELD: Held = { ctrl: false, shift: false, alt: false };

const NO_KEY_HELD = { ctrlKey: false, metaKey: false, shiftKey: false, altKey: false };

export async function createTestTimeline() {
  const { device, notices, robots, noticeTexts } = await createTestPage();
  const storage = { getItem: () => null, setItem: () => undefined };
  const document = createDocument(storage, notices, device.clock);
  const view = createView({ browser: storage, tab: storage });
  const stores = { device, notices, robots, document, view, timeline: createTimeline() };
  document.edit(() => 'fill', smallGroup);
  stores.timeline.setState({
    time: { fromMs: 0, msPerPx: 10 },
    widthPx: 800,
    heightPx: 400,
    followsGroup: false,
  });
  const context = () => contextOf(stores);
  const group = () => document.store.getState().present;

  /** Where a key of the servo is on the tracks. */
  const spotIn = (servo: number, frame: number, sizes: Sizes) => {
    const scene = sceneOf(context(), sizes);
    const row = scene.rows.find(({ row: { servos } }) => servos[0] === servo);
    const key = context()
      .times.tracks.get(servo)
      ?.keys.find(({ frameId }) => frameId === frame);
    if (row === undefined || key === undefined)
      throw new Error(`servo ${servo} has no key in frame ${frame}`);
    return { x: xOf(scene.state.time, key.atMs), y: keyY(row, key.position, scene.family) };
  };

  const spotOf = (servo: number, frame: number) => spotIn(servo, frame, SIZES);

  const press = (
    spot: { x: number; y: number },
    held: Partial<Held> = {},
    isTouch = false,
    sizes = SIZES,
  ) => {
    const all = { ...NOTHING_HELD, ...held };
    const gesture = gestureOf({
      ...{ stores, spot, isTouch, sizes, held: all },
      ...{ showBox: () => undefined, scroll: () => undefined },
    });
    return {
      ...gesture,
      by: (x: number, y: number, now: Partial<Held> = held) =>
        gesture.move({ x: spot.x + x, y: spot.y + y }, { ...NOTHING_HELD, ...now }),
    };
  };

  return {
    ...{ stores, context, group, noticeTexts, spotOf, spotIn, press },
    select: (...keys: readonly (readonly [frameId: number, servo: number])[]) =>
      select(stores, keySet(keys.map(([frameId, servo]) => ({ frameId, servo })))),
    /** Servo by servo, in the order of time. */
    selected: () =>
      selectedKeys(context().times, stores.timeline.getState().selected).map(({ frameId, servo }) => [
        frameId,
        servo,
      ]),
    drag(spot: { x: number; y: number }, x: number, y: number, held: Partial<Held> = {}) {
      const gesture = press(spot, held);
      gesture.by(x, y);
      gesture.end(false);
    },
    click: (spot: { x: number; y: number }, held: Partial<Held> = {}) => press(spot, held).end(true),
    key: (key: string, held: { ctrlKey?: boolean; shiftKey?: boolean } = {}) =>
      pressInTimeline(context(), { ...NO_KEY_HELD, key, ...held }),
    steps: () => document.store.getState().past.length - 1,
    /** Times and positions of a servo's keys. */
    keys: (servo: number) =>
      context()
        .times.tracks.get(servo)
        ?.keys.map(({ atMs, position }) => [atMs, position]) ?? [],
  };
}
