// The timeline with the largest group, 255 frames of 32 servos: how long it takes to come up, how long an edit keeps the page,
// and how many frames are drawn while the playhead is scrubbed on a processor slowed down four times. Beside it stands a plain
// grid with an element for each key, in the same browser, right before.

import type { Page } from '@playwright/test';
import { emptyGroup, type ActionGroup, groupToText } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { drawing, DUE, ROBOTS, SLOWER, type Drawing } from './frames.ts';
import { mainThreadOf, type MainThread } from './mainThread.ts';
import { openDashboard, withBoard, withPage } from './station.ts';
import { median } from './statistics.ts';

const FRAMES = 255;
const SERVOS = 32;
const REPEATS = amount(3, 1);
const REST_MS = 300;
const MOUNT_LIMIT_MS = 50;
const EDIT_LIMIT_MS = 2;
const BULK_LIMIT_MS = 16;
/** The middle of the row of all servos, below ruler and heads. */
const ALL_ROW_PX = 57;
const SIZE = `${FRAMES} frames of ${SERVOS} servos`;

interface Measured {
  readonly mountMs: number;
  /** Of one key. */
  readonly editMs: number;
  /** Of all keys of a frame. */
  readonly frameEditMs: number;
  /** With layout and paint, in time of the main thread. */
  readonly wholeEditMs: number;
  readonly scrub: Drawing;
}

export function measureTracks(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      const stored = { 'servodeck.robots': ROBOTS, 'servodeck.group': groupToText(largestGroup()) };
      await page.addInitScript((texts) => {
        for (const [key, text] of Object.entries(texts)) localStorage.setItem(key, text);
      }, stored);
      const thread = await mainThreadOf(page);
      await page.goto(`${url}/api/health`);
      const plain = await measurePlainGrid(page, thread);
      await openDashboard(page, url);
      const mountMs = await mountTime(page);
      await selectFrame(page);
      const frameEdits = await thread.work(() => editTime(page));
      await selectKey(page);
      const editMs = await editTime(page);
      const bulk = await bulkEdits(page);
      await scrub(page);
      const edits = { editMs, frameEditMs: frameEdits.result, wholeEditMs: frameEdits.allMs / REPEATS };
      const ours = { mountMs, ...edits };
      return [...figuresOf({ ...ours, scrub: await drawing(page, thread) }, plain), ...bulk];
    }),
  );
}

function figuresOf(ours: Measured, plain: Measured): Figure[] {
  const figure = (name: string, unit: string, of: (measured: Measured) => number, note: string): Figure => ({
    ...{ key: `lanes.${name}`, value: of(ours), unit, note },
    against: { what: 'an element a key', value: of(plain) },
  });
  return [
    figure(
      'mountMs',
      'ms',
      (one) => one.mountMs,
      `panel with the timeline, to its first frame, ${SIZE}; aim ${MOUNT_LIMIT_MS}`,
    ),
    figure('editMs', 'ms', (one) => one.editMs, `script of a key's nudge, ${SIZE}; aim ${EDIT_LIMIT_MS}`),
    figure(
      'frameEditMs',
      'ms',
      (one) => one.frameEditMs,
      `script of a nudge of the ${SERVOS} keys of a frame; aim ${EDIT_LIMIT_MS}`,
    ),
    figure(
      'wholeEditMs',
      'ms',
      (one) => one.wholeEditMs,
      "the main thread's work for it, with layout and paint",
    ),
    figure(
      'scrub.drawn',
      '',
      (one) => one.scrub.drawn,
      `playhead scrubbed in each frame; processor ${SLOWER} times slower; ${DUE} were due`,
    ),
    figure('scrub.frameMs', 'ms', (one) => one.scrub.frameMs, "the main thread's work for a frame of that"),
  ];
}

/** What most would write: a table with a cell for each key, and a line that is moved over it. */
async function measurePlainGrid(page: Page, thread: MainThread): Promise<Measured> {
  await page.setContent(
    '<style>td { border: 1px solid; } #line { position: fixed; inset-block: 0; border: 1px solid; }</style>',
  );
  const mountMs = await page.evaluate(
    async ({ frames, servos }) => {
      const startMs = performance.now();
      const cells = (servo: number) =>
        Array.from({ length: frames }, (_, frame) => `<td>${1500 + servo + frame}</td>`).join('');
      const rows = Array.from({ length: servos }, (_, servo) => `<tr>${cells(servo)}</tr>`).join('');
      document.body.innerHTML = `<div id="line"></div><table>${rows}</table>`;
      await new Promise(requestAnimationFrame);
      await new Promise((resolve) => setTimeout(resolve));
      return performance.now() - startMs;
    },
    { frames: FRAMES, servos: SERVOS },
  );
  const frameEdits = await thread.work(() => plainEditTime(page, SERVOS));
  const editMs = await plainEditTime(page, 1);
  await page.evaluate(() => {
    const line = document.getElementById('line');
    let frame = 0;
    requestAnimationFrame(function move() {
      frame += 1;
      if (line !== null) line.style.left = `${400 + 300 * Math.sin(frame / 40)}px`;
      requestAnimationFrame(move);
    });
  });
  const scrubbed = await drawing(page, thread);
  const edits = { editMs, frameEditMs: frameEdits.result, wholeEditMs: frameEdits.allMs / REPEATS };
  return { mountMs, ...edits, scrub: scrubbed };
}

/** `count` of one column. */
async function plainEditTime(page: Page, count: number): Promise<number> {
  const times = await page.evaluate(
    async ({ repeats, cells, columns }) => {
      const all: number[] = [];
      for (let repeat = 0; repeat < repeats; repeat += 1) {
        const startMs = performance.now();
        const every = document.querySelectorAll('td');
        for (let row = 0; row < cells; row += 1) {
          const cell = every[row * columns + 120];
          if (cell !== undefined) cell.textContent = String(1500 + repeat);
        }
        all.push(performance.now() - startMs);
        await new Promise(requestAnimationFrame);
      }
      return all;
    },
    { repeats: REPEATS, cells: count, columns: FRAMES },
  );
  return median(times);
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

/** From choosing the action group, on a page at rest, to the frame in which it stands there. */
async function mountTime(page: Page): Promise<number> {
  const times: number[] = [];
  for (let repeat = 0; repeat < REPEATS; repeat += 1) {
    await page.getByRole('radio', { name: 'Poses' }).check();
    // What it showed before is still on its way to the screen, and the frame would wait for that.
    await page.waitForTimeout(REST_MS);
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

/** In the row of all servos. */
async function selectFrame(page: Page): Promise<void> {
  await page.getByRole('grid').focus();
  await page.keyboard.press('k');
}

/** In the first servo's row. */
async function selectKey(page: Page): Promise<void> {
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('k');
}

async function editTime(page: Page, key = 'ArrowUp', repeats = REPEATS): Promise<number> {
  // All in one go: to find the grid by its role costs the page as much as an edit.
  const times = await page.getByRole('grid').evaluate(
    async (element, pressed) => {
      const all: number[] = [];
      for (let repeat = 0; repeat < pressed.repeats; repeat += 1) {
        const startMs = performance.now();
        element.dispatchEvent(
          new KeyboardEvent('keydown', { key: pressed.key, bubbles: true, cancelable: true }),
        );
        await Promise.resolve();
        all.push(performance.now() - startMs);
        await new Promise(requestAnimationFrame);
      }
      return all;
    },
    { key, repeats },
  );
  return median(times);
}

/** Of all keys at once: by an arrow key up and to the right, by a drag, and turned round in time. */
async function bulkEdits(page: Page): Promise<readonly Figure[]> {
  await page.keyboard.press('Control+a');
  const reverses = await editTime(page, 'r', 1);
  await page.keyboard.press('Control+a');
  const times = {
    reverse: reverses,
    nudge: await editTime(page),
    timeNudge: await editTime(page, 'ArrowRight'),
    dragMove: await dragTime(page),
  };
  const notes = {
    reverse: 'script of the first time that all keys are turned round',
    nudge: 'script of a nudge of all keys up',
    timeNudge: 'script of a nudge of all keys to the right',
    dragMove: 'script of a movement of the pointer that drags all keys',
  };
  return Object.entries(times).map(([name, value]) => ({
    ...{ key: `lanes.all.${name}Ms`, value, unit: 'ms', limit: { atMost: BULK_LIMIT_MS } },
    note: `${notes[name as keyof typeof times]}, ${FRAMES * SERVOS} of them`,
  }));
}

/** In the row of all servos, in time and value. */
async function dragTime(page: Page): Promise<number> {
  const canvas = page.getByRole('grid').locator('canvas').first();
  const times = await canvas.evaluate(
    async (element, { repeats, y }) => {
      const { left, top, width } = element.getBoundingClientRect();
      Element.prototype.setPointerCapture = () => undefined;
      const send = (type: string, x: number): void =>
        void element.dispatchEvent(
          new PointerEvent(type, {
            ...{ bubbles: true, pointerId: 1, pointerType: 'mouse', button: 0, buttons: 1 },
            ...{ clientX: left + x, clientY: top + y },
          }),
        );
      const all: number[] = [];
      send('pointerdown', width / 2);
      for (let repeat = 1; repeat <= repeats; repeat += 1) {
        const startMs = performance.now();
        send('pointermove', width / 2 + 4 + 2 * repeat);
        await Promise.resolve();
        all.push(performance.now() - startMs);
        await new Promise(requestAnimationFrame);
      }
      send('pointerup', width / 2 + 4);
      return all;
    },
    { repeats: REPEATS, y: ALL_ROW_PX },
  );
  return median(times);
}

async function scrub(page: Page): Promise<void> {
  await page
    .getByRole('grid')
    .locator('canvas')
    .first()
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
