// How many frames a second the page draws of an 18-servo humanoid in three dimensions while all of it moves, and on a processor slowed
// down four times. On a machine without a graphics processor the browser computes each picture itself, which the note says.

import type { Page } from '@playwright/test';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { robotToText } from '#shared/profile/robotText.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { centre, framesDrawn, moveAll, SLOWER } from './frames.ts';
import { mainThreadOf } from './mainThread.ts';
import { openDashboard, withBoard, withPage } from './station.ts';

const MEASURE_MS = amount(1_200, 400);
const HUMANOID = readyRobot('humanoid18', 'doc', {
  robot: 'Humanoid',
  role: (role, servo) => `${role} ${servo}`,
  limb: (limb) => limb,
});
const ROBOTS = JSON.stringify({ files: [{ id: 1, file: robotToText(HUMANOID) }], currentId: 1, nextId: 2 });

export function measureThree(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await page.addInitScript((robots) => localStorage.setItem('servodeck.robots', robots), ROBOTS);
      const thread = await mainThreadOf(page);
      await openDashboard(page, url);
      await centre(page, HUMANOID.servos.length);
      await moveAll(page);
      await page.getByRole('radio', { name: '3D' }).check();
      await page.getByRole('img', { name: /in three dimensions/ }).waitFor();
      const perSecond = (drawn: number): number => (drawn * 1_000) / MEASURE_MS;
      const { allMs, result } = await thread.work(() => framesDrawn(page, MEASURE_MS));
      await thread.slowDown(SLOWER);
      const slow = await framesDrawn(page, MEASURE_MS);
      await thread.slowDown(1);
      const what = `an 18-servo humanoid under way, drawn by ${await rendererOf(page)}`;
      return [
        { key: 'three.fps', value: perSecond(result), unit: 'fps', note: what },
        {
          key: 'three.fpsSlow',
          value: perSecond(slow),
          unit: 'fps',
          note: `processor ${SLOWER} times slower`,
        },
        {
          key: 'three.frameMs',
          value: allMs / result,
          unit: 'ms',
          note: "the main thread's work for a frame",
        },
      ];
    }),
  );
}

function rendererOf(page: Page): Promise<string> {
  return page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    const info = gl?.getExtension('WEBGL_debug_renderer_info');
    return String(gl?.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? 0));
  });
}
