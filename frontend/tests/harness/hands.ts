// Mouse, keys and fingers of a person at the page: real input of the browser, after which one frame passes. Knows places in the
// page, not what stands there.

import { commands } from 'vitest/browser';
import type { Act, Touch } from './commands.ts';
import { advance, FRAME_MS } from './time.ts';

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

export async function clickAt({ x, y }: Point, times = 1): Promise<void> {
  const presses = Array.from({ length: times }, (_, index): Act[] => [
    ['down', index + 1],
    ['up', index + 1],
  ]);
  await act(['move', x, y], ...presses.flat());
}

export const mouse = {
  move: (x: number, y: number, { steps = 1 }: { steps?: number } = {}) => act(['move', x, y, steps]),
  down: () => act(['down']),
  up: () => act(['up']),
  wheel: (byX: number, byY: number) => act(['wheel', byX, byY]),
  click: (x: number, y: number) => clickAt({ x, y }),
  dblclick: (x: number, y: number) => clickAt({ x, y }, 2),
};

export const keyboard = {
  press: (key: string) => act(['press', key]),
  down: (key: string) => act(['keyDown', key]),
  up: (key: string) => act(['keyUp', key]),
  type: (text: string) => act(['type', text]),
  insertText: (text: string) => act(['insertText', text]),
};

/** Fingers of a screen: they scroll, rest and come in twos. */
export async function touch(type: Touch, ...points: readonly Point[]): Promise<void> {
  await act(['touch', type, points.map((point, id) => ({ ...point, id }))]);
}

export async function tapAt(point: Point): Promise<void> {
  await act(['touch', 'touchStart', [{ ...point, id: 0 }]], ['touch', 'touchEnd', []]);
}
