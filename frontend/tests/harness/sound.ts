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

const isDialogOpen = (): boolean => document.querySelector('[role="dialog"], [role="alertdialog"]') !== null;

/** What axe objects to in `place`; `rules` null for all of them. */
export async function objections(
  place: Document | Element = document,
  rules: readonly string[] | null = null,
): Promise<readonly string[]> {
  // A colour on its way to another is none of the state's.
  for (const one of document.getAnimations()) if (one instanceof CSSTransition) one.finish();
  const { violations } = await during(
    axe.run(place, {
      ...{ preload: false, resultTypes: ['violations'] },
      rules: {
        // Four fifths of axe's time; the colours themselves are proved from the tokens.
        'color-contrast': { enabled: isExhaustive },
        // Behind an open dialog the page is hidden, with its landmark and its heading.
        'landmark-one-main': { enabled: !isDialogOpen() },
        'page-has-heading-one': { enabled: !isDialogOpen() },
      },
      ...(rules === null ? {} : { runOnly: [...rules] }),
    }),
  );
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(' | ')}`);
}

/** What is behind a dialog is locked a moment before its content has come. */
const isWaitingForDialog = (): boolean =>
  document.documentElement.style.overflow === 'hidden' && !isDialogOpen();

export async function expectSound(state: string, { isDark = false } = {}): Promise<void> {
  await expect.poll(isWaitingForDialog, { message: `${state}: a dialog comes` }).toBe(false);
  expect.soft(await objections(document, isDark ? ['color-contrast'] : null), state).toEqual([]);
  await expectNoSidewaysScroll(state);
}

export async function expectNoSidewaysScroll(state: string): Promise<void> {
  const overflow = (): number =>
    [document.documentElement, ...document.querySelectorAll('[role="dialog"], [role="alertdialog"]')]
      .map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)
      .reduce((most, pixels) => Math.max(most, pixels));
  await expect.poll(overflow, { message: `${state}: pixels beyond the right edge` }).toBe(0);
}
