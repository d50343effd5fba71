// Mouse, keys and fingers of a person at the page: real input of the browser, after which one frame passes. Knows places in the
// page, not what stands there.

import { commands } from 'vitest/browser';
import type { Act, MouseButton, Touch } from './commands.ts';
import { advance, FRAME_MS, realFrame, realMoment } from './time.ts';

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Where the page lies in the window. */
function origin(): Point {
  const { x = 0, y = 0 } = window.frameElement?.getBoundingClientRect() ?? {};
  return { x, y };
}

function inWindow(act: Act): Act {
  const { x, y } = origin();
  if (act[0] === 'move') return ['move', act[1] + x, act[2] + y, act[3] ?? 1];
  if (act[0] !== 'touch') return act;
  return ['touch', act[1], act[2].map((point) => ({ ...point, x: point.x + x, y: point.y + y }))];
}

export async function act(...acts: readonly Act[]): Promise<void> {
  if (acts.length > 0) await commands.act(acts.map(inWindow));
  await advance(FRAME_MS);
}

interface Press {
  readonly button?: MouseButton;
}

export async function clickAt({ x, y }: Point, times = 1, { button = 'left' }: Press = {}): Promise<void> {
  const presses = Array.from({ length: times }, (_, index): Act[] => [
    ['down', index + 1, button],
    ['up', index + 1, button],
  ]);
  await act(['move', x, y], ...presses.flat());
}

export const mouse = {
  move: (x: number, y: number, { steps = 1 }: { steps?: number } = {}) => act(['move', x, y, steps]),
  down: ({ button = 'left' }: Press = {}) => act(['down', 1, button]),
  up: ({ button = 'left' }: Press = {}) => act(['up', 1, button]),
  wheel: (byX: number, byY: number) => act(['wheel', byX, byY]),
  click: (x: number, y: number, press?: Press) => clickAt({ x, y }, 1, press),
  dblclick: (x: number, y: number) => clickAt({ x, y }, 2),
};

export const keyboard = {
  press: (key: string) => act(['press', key]),
  down: (key: string) => act(['keyDown', key]),
  up: (key: string) => act(['keyUp', key]),
  type: (text: string) => act(['type', text]),
  insertText: (text: string) => act(['insertText', text]),
};

/** A finger scrolls, and what it tapped is pressed, when the browser draws next. */
async function actByTouch(...acts: readonly Act[]): Promise<void> {
  await commands.act(acts.map(inWindow));
  await realFrame();
  await advance(FRAME_MS);
}

/** For a browser a finger that has not moved for so long throws nothing when it is lifted. */
const RESTS_MS = 60;

const SWIPE_STEPS = 8;
const fingers = (...points: readonly Point[]) => points.map((point, id) => ({ ...point, id }));

export const touchscreen = {
  touch: (type: Touch, ...points: readonly Point[]) => actByTouch(['touch', type, fingers(...points)]),
  tap: (x: number, y: number) =>
    actByTouch(['touch', 'touchStart', fingers({ x, y })], ['touch', 'touchEnd', []]),
  /** One finger from here to there, in steps that a browser takes for a drag; what it scrolled does not run on. */
  async swipe(from: Point, to: Point): Promise<void> {
    const moves = Array.from({ length: SWIPE_STEPS }, (_, index): Act => {
      const share = (index + 1) / SWIPE_STEPS;
      const at = { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
      return ['touch', 'touchMove', fingers(at)];
    });
    await actByTouch(['touch', 'touchStart', fingers(from)], ...moves);
    await realMoment(RESTS_MS);
    await actByTouch(['touch', 'touchEnd', []]);
  },
};
