// The timeline with the largest group, 255 frames of 32 servos: how long it takes to come up, how long an edit keeps the page,
// and how many frames are drawn while the playhead is scrubbed on a processor slowed down four times.

import type { Page } from '@playwright/test';
import { emptyGroup, type ActionGroup } from '#shared/actions/group/group.ts';
import { insertFrame } from '#shared/actions/group/groupEdits.ts';
import { groupToText } from '#shared/actions/group/groupText.ts';
import type { Figure } from './figure.ts';
import { DUE, framesDrawn, ROBOTS, SLOWER } from './frames.ts';
import { openDashboard, withBoard, withPage } from './station.ts';
import { median } from './statistics.ts';

const FRAMES = 255;
const SERVOS = 32;
const REPEATS = 15;
const MOUNT_LIMIT_MS = 50;
const EDIT_LIMIT_MS = 2;
const SIZE = `${FRAMES} frames of ${SERVOS} servos`;

export function measureLanes(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      const kept = { 'servodeck.robots': ROBOTS, 'servodeck.group': groupToText(largestGroup()) };
      await page.addInitScript((texts) => {
        for (const [key, text] of Object.entries(texts)) localStorage.setItem(key, text);
      }, kept);
      await openDashboard(page, url);
      const mountMs = await mountTime(page);
      const editMs = await editTime(page);
      const processor = await page.context().newCDPSession(page);
      await processor.send('Emulation.setCPUThrottlingRate', { rate: SLOWER });
      await scrub(page);
      const drawn = await framesDrawn(page);
      return [
        figure(
          'mountMs',
          mountMs,
          'ms',
          MOUNT_LIMIT_MS,
          `panel with timeline and strip, ${SIZE}; median of ${REPEATS}`,
        ),
        figure(
          'editMs',
          editMs,
          'ms',
          EDIT_LIMIT_MS,
          `script of one nudge without the paint, ${SIZE}; median of ${REPEATS}`,
        ),
        figure(
          'scrub.drawn',
          drawn,
          '',
          DUE,
          `playhead scrubbed in each frame; processor ${SLOWER} times slower`,
        ),
      ];
    }),
  );
}

function figure(name: string, value: number, unit: string, limit: number, note: string): Figure {
  return { key: `lanes.${name}`, value, unit, against: { what: 'aim', value: limit }, note };
}

function largestGroup(): ActionGroup {
  return Array.from({ length: FRAMES }).reduce<ActionGroup>(
    (group, _, frame) => {
      const targets = Array.from({ length: SERVOS }, (_, index) => ({
        servo: index + 1,
        position: Math.round(1500 + 700 * Math.sin(frame * 0.3 + index)),
      }));
      return insertFrame(group, frame, { durationMs: 200, targets });
    },
    emptyGroup('Largest', 'us'),
  );
}

/** From choosing the action group to the frame in which it stands there. */
async function mountTime(page: Page): Promise<number> {
  const times: number[] = [];
  for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    await page.getByRole('radio', { name: 'Poses' }).check();
    times.push(
      await page.getByRole('radio', { name: 'Action group' }).evaluate(
        (radio) =>
          new Promise<number>((resolve) => {
            const startMs = performance.now();
            (radio as HTMLElement).click();
            requestAnimationFrame(() => {
              const channel = new MessageChannel();
              channel.port1.onmessage = () => resolve(performance.now() - startMs);
              channel.port2.postMessage(null);
            });
          }),
      ),
    );
  }
  return median(times);
}

async function editTime(page: Page): Promise<number> {
  const grid = page.getByRole('grid');
  await grid.focus();
  await page.keyboard.press('k');
  const times: number[] = [];
  for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    times.push(
      await grid.evaluate(async (element) => {
        const startMs = performance.now();
        element.dispatchEvent(
          new KeyboardEvent('keydown', { key: 'ArrowUp', bubbles: true, cancelable: true }),
        );
        await Promise.resolve();
        return performance.now() - startMs;
      }),
    );
  }
  return median(times);
}

async function scrub(page: Page): Promise<void> {
  await page
    .getByRole('grid')
    .locator('canvas')
    .evaluate((canvas) => {
      const { left, top, width } = canvas.getBoundingClientRect();
      const send = (type: string, x: number): void =>
        void canvas.dispatchEvent(
          new PointerEvent(type, {
            ...{ bubbles: true, pointerId: 1, pointerType: 'mouse', button: 0, buttons: 1 },
            ...{ clientX: left + x, clientY: top + 8 },
          }),
        );
      Element.prototype.setPointerCapture = () => undefined;
      send('pointerdown', width / 2);
      let frame = 0;
      requestAnimationFrame(function drag() {
        frame += 1;
        send('pointermove', width * (0.5 + 0.4 * Math.sin(frame / 40)));
        requestAnimationFrame(drag);
      });
    });
}
