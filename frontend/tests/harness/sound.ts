// What axe objects to in the page as it stands, and what has to be scrolled sideways. Once for each state of a panel; dark differs
// from light in its colours only.

import axe from 'axe-core';
import { inject } from 'vitest';
import { expect } from './expect.ts';
import { during } from './time.ts';

declare module 'vitest' {
  interface ProvidedContext {
    /** Every look of every state, as `npm run test:all` has it. */
    isExhaustive: boolean;
  }
}

export const isExhaustive = inject('isExhaustive');

/** One of a list, or all of it where every look is looked at. */
export const looks = <const All extends readonly unknown[]>(all: All): readonly All[number][] =>
  isExhaustive ? all : all.slice(0, 1);

export async function expectSound(state: string, { isDark = false } = {}): Promise<void> {
  const { violations } = await during(
    axe.run(document, isDark ? { runOnly: { type: 'rule', values: ['color-contrast'] } } : {}),
  );
  const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`);
  expect.soft(found, state).toEqual([]);
  await expectNoSidewaysScroll(state);
}

export async function expectNoSidewaysScroll(state: string): Promise<void> {
  const overflow = (): number =>
    [document.documentElement, ...document.querySelectorAll('[role="dialog"], [role="alertdialog"]')]
      .map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)
      .reduce((most, pixels) => Math.max(most, pixels));
  await expect.poll(overflow, { message: `${state}: pixels beyond the right edge` }).toBe(0);
}
