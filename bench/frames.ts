// How many animation frames the real page draws while 32 sliders change in each of them, on a processor slowed down four
// times: with all servos under way and nobody's hand on them, and with all of them dragged together. And what a frame costs
// the main thread, which says the same on a machine that others use too. Beside it stand bare sliders in the same browser,
// right before.

import type { Page } from '@playwright/test';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotToText } from '#shared/profile/robotText.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { mainThreadOf, type MainThread } from './mainThread.ts';
import { openDashboard, withBoard, withPage } from './station.ts';

export const SLOWER = 4;
const MEASURE_MS = amount(1_400, 300);
const FRAMES_PER_SECOND = 60;
export const DUE = (MEASURE_MS / 1_000) * FRAMES_PER_SECOND;
/** Longer than it is looked at: each servo is under way all the time. */
const MOVE_MS = 20_000;

export const ROBOT = readyRobot('plain32', 'doc', {
  robot: 'Thirty-two',
  role: (role, servo) => `${role} ${servo}`,
  limb: (limb) => limb,
});
export const ROBOTS = JSON.stringify({
  files: [{ id: 1, file: robotToText(ROBOT) }],
  currentId: 1,
  nextId: 2,
});

export function measureFrames(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await page.addInitScript((robots) => localStorage.setItem('servodeck.robots', robots), ROBOTS);
      const thread = await mainThreadOf(page);
      await changeBareSliders(page);
      const bare = await drawing(page, thread);
      await openDashboard(page, url);
      await centre(page);
      await moveAll(page);
      const moving = await drawing(page, thread);
      await dragAll(page);
      const dragging = await drawing(page, thread);
      await requireDragged(page);
      return [
        ...figures('moving', moving, bare, 'estimates of 32 servos under way'),
        ...figures('dragging', dragging, bare, 'targets and estimates of 32 servos dragged together'),
      ];
    }),
  );
}

function figures(name: string, ours: Drawing, bare: Drawing, what: string): readonly Figure[] {
  const beside = (value: number) => ({ what: '32 bare sliders', value });
  return [
    {
      ...{ key: `frames.${name}.drawn`, value: ours.drawn, unit: '', against: beside(bare.drawn) },
      note: `${what}; processor ${SLOWER} times slower; ${DUE} were due`,
    },
    {
      ...{ key: `frames.${name}.frameMs`, value: ours.frameMs, unit: 'ms', against: beside(bare.frameMs) },
      note: `the main thread's work for a frame of that; there are ${(1_000 / FRAMES_PER_SECOND / SLOWER).toFixed(1)}`,
    },
  ];
}

export interface Drawing {
  /** At the slowed-down processor. */
  readonly drawn: number;
  /** As fast as the processor is. */
  readonly frameMs: number;
}

/** While something goes on in the page by itself. */
export async function drawing(page: Page, thread: MainThread): Promise<Drawing> {
  const { allMs, result } = await thread.work(() => framesDrawn(page, MEASURE_MS / 2));
  await thread.slowDown(SLOWER);
  const drawn = await framesDrawn(page, MEASURE_MS);
  await thread.slowDown(1);
  return { drawn, frameMs: allMs / result };
}

/** Nothing but native sliders that all change in each frame: what this browser manages on this machine just now. */
async function changeBareSliders(page: Page): Promise<void> {
  await page.setContent('<input type="range" max="1000" />'.repeat(ROBOT.servos.length));
  await page.getByRole('slider').evaluateAll((sliders) => {
    let frame = 0;
    requestAnimationFrame(function change() {
      frame += 1;
      for (const [index, slider] of sliders.entries())
        if (slider instanceof HTMLInputElement)
          slider.valueAsNumber = Math.round(500 + 400 * Math.sin(frame / 40 + index));
      requestAnimationFrame(change);
    });
  });
}

/** Nothing is estimated of a servo before its first move has ended. */
export async function centre(page: Page, count = ROBOT.servos.length): Promise<void> {
  await page.getByRole('button', { name: 'Centre all' }).click();
  await page
    .getByText(/^≈ 1500$/)
    .nth(count - 1)
    // A row scrolled out of sight is not painted.
    .waitFor({ state: 'attached' });
}

export async function moveAll(page: Page): Promise<void> {
  await page.getByRole('radio', { name: 'Fixed time' }).check();
  const time = page.getByRole('textbox', { name: 'Move time in milliseconds' });
  await time.fill(String(MOVE_MS));
  await time.press('Enter');
  await page.getByRole('button', { name: 'Select all' }).click();
  await page.getByRole('slider').first().press('End');
  await page.getByRole('radio', { name: 'Follow the pointer' }).check();
}

/** In a page that changes in each of them. */
export function framesDrawn(page: Page, forMs: number): Promise<number> {
  return page.evaluate(
    (measureMs) =>
      new Promise<number>((resolve) => {
        let drawn = -1;
        let startMs = 0;
        requestAnimationFrame(function count(nowMs) {
          if (drawn < 0) startMs = nowMs;
          drawn += 1;
          if (nowMs - startMs >= measureMs) resolve(drawn);
          else requestAnimationFrame(count);
        });
      }),
    forMs,
  );
}

/** The first slider takes all others along. */
async function dragAll(page: Page): Promise<void> {
  const slider = page.getByRole('slider').first();
  await slider.hover();
  await page.mouse.down();
  await slider.evaluate(dragInEachFrame);
}

/** A link that fell behind stops the robot: frames in which nothing moves would be quick ones. */
async function requireDragged(page: Page): Promise<void> {
  // The one dragged takes this one along; those farther down are out of sight, and written when they rest.
  const second = page.getByRole('slider').nth(1);
  const before = await second.inputValue();
  await page
    .waitForFunction(([slider, value]) => slider instanceof HTMLInputElement && slider.value !== value, [
      await second.elementHandle(),
      before,
    ] as const)
    .catch(() => {
      throw new Error('The sliders were no longer dragged.');
    });
}

/** Runs in the page: the mouse that holds the slider is elsewhere in every frame. */
function dragInEachFrame(slider: Element): void {
  const { left, width } = slider.getBoundingClientRect();
  const pointerId = 1; // the mouse's, in Chromium
  let frame = 0;
  requestAnimationFrame(function drag() {
    frame += 1;
    const clientX = left + width * (0.5 + 0.3 * Math.sin(frame / 40));
    slider.dispatchEvent(new PointerEvent('pointermove', { bubbles: true, pointerId, clientX }));
    requestAnimationFrame(drag);
  });
}
