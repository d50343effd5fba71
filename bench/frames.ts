// How many animation frames the real page draws while 32 sliders change in each of them, on a processor slowed down four
// times: with all servos under way and nobody's hand on them, and with all of them dragged together. Beside it stand bare
// sliders in the same browser, right before.

import type { Page } from '@playwright/test';
import { readyRobot } from '#shared/actions/robot/readyRobots.ts';
import { robotToText } from '#shared/actions/robot/robotText.ts';
import type { Figure } from './figure.ts';
import { openDashboard, withBoard, withPage } from './station.ts';

export const SLOWER = 4;
const MEASURE_MS = 4_000;
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
      const processor = await page.context().newCDPSession(page);
      const slowDown = (rate: number) => processor.send('Emulation.setCPUThrottlingRate', { rate });
      await slowDown(SLOWER);
      const bare = await framesOfBareSliders(page);
      await slowDown(1);
      await openDashboard(page, url);
      await centre(page);
      await slowDown(SLOWER);
      await moveAll(page);
      const moving = await framesDrawn(page);
      await page.getByRole('slider').first().evaluate(dragInEachFrame);
      const dragging = await framesDrawn(page);
      return [
        figure('moving', moving, bare, 'estimates of 32 servos under way'),
        figure('dragging', dragging, bare, 'targets and estimates of 32 servos dragged together'),
      ];
    }),
  );
}

function figure(name: string, value: number, bare: number, what: string): Figure {
  return {
    ...{ key: `frames.${name}.drawn`, value, unit: '' },
    against: { what: '32 bare sliders', value: bare },
    note: `${what}; processor ${SLOWER} times slower; ${DUE} were due`,
  };
}

/** Nothing but native sliders that all change in each frame: what this browser manages on this machine just now. */
async function framesOfBareSliders(page: Page): Promise<number> {
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
  return framesDrawn(page);
}

/** Nothing is estimated of a servo before its first move has ended. */
async function centre(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Centre all' }).click();
  await page
    .getByText(/^≈ 1500$/)
    .nth(ROBOT.servos.length - 1)
    // A row scrolled out of sight is not painted.
    .waitFor({ state: 'attached' });
}

async function moveAll(page: Page): Promise<void> {
  await page.getByRole('radio', { name: 'In a set time' }).check();
  const time = page.getByRole('textbox', { name: 'Move time in milliseconds' });
  await time.fill(String(MOVE_MS));
  await time.press('Enter');
  await page.getByRole('button', { name: 'Select all' }).click();
  await page.getByRole('slider').first().press('End');
  await page.getByRole('radio', { name: 'As fast as my hand' }).check();
}

export function framesDrawn(page: Page): Promise<number> {
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
    MEASURE_MS,
  );
}

/** Runs in the page: the first slider is dragged to another value in every frame, and takes all others along. */
function dragInEachFrame(slider: HTMLElement | SVGElement): void {
  let frame = 0;
  requestAnimationFrame(function drag() {
    frame += 1;
    if (slider instanceof HTMLInputElement) {
      slider.valueAsNumber = Math.round(1500 + 600 * Math.sin(frame / 40));
      slider.dispatchEvent(new InputEvent('input', { bubbles: true }));
    }
    requestAnimationFrame(drag);
  });
}
