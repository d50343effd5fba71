// From the press on STOP in the real page to the first stop byte at the board's pins, over gateway and pty at 9600 baud:
// what the person's finger meets. In two states: nothing else goes on, and all sliders are dragged at once; others are
// stopStates.ts.
//
// The press is the browser's own time of the pointer event, the byte is in the bus log; both count from the epoch. Beside
// it stands what the wire alone costs: a packet that has begun to leave cannot be recalled, and the board needs its gap.

import type { Page } from '@playwright/test';
import { family } from '#shared/codec/families.ts';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { stopFigures, stopTimes, type StopTimes } from './presses.ts';
import { withBoard, withDashboard, type BoardOnPort } from './station.ts';

const PRESSES = amount(15, 3);
/** Between Resume and the next press: at any moment of the packet on the wire, whose cycle is about 36 ms. */
const PAUSE_MS = { shortest: 60, longest: 110 };
/** A stop goes out at 0, 70 and 140 ms, then the hold. */
const SEQUENCE_MS = 220;
const STOPS_PER_PRESS = 3;
const GAP_MS = family('doc').serviceGapMs;

export function measureStopIdle(): Promise<Figure[]> {
  return withDashboard(withBoard, async (page, board) =>
    stopFigures(
      'stop.idle',
      await timesOfPresses(page, board, PRESSES),
      'in the page; nothing else on the wire',
    ),
  );
}

export function measureStopDragging(): Promise<Figure[]> {
  return withDashboard(withBoard, (page, board) => stopsWhileDragging('stop.dragging', page, board, PRESSES));
}

/** On a page that shows the dashboard; it goes on dragging behind that. */
export async function stopsWhileDragging(
  name: string,
  page: Page,
  board: BoardOnPort,
  presses: number,
): Promise<Figure[]> {
  await page.getByRole('slider').evaluateAll(dragInPage);
  return stopFigures(name, await timesOfPresses(page, board, presses), 'in the page; all sliders dragged');
}

async function timesOfPresses(page: Page, board: BoardOnPort, presses: number): Promise<StopTimes> {
  const fromMs = Date.now();
  const pressedMs = await pressAgainAndAgain(page, presses);
  const packets = packetsInto(board.readBusLog().filter(({ atMs }) => atMs >= fromMs));
  return stopTimes(pressedMs, packets, { gapMs: GAP_MS, stopsPerPress: STOPS_PER_PRESS });
}

/** Returns when each press was, in milliseconds since the epoch. */
async function pressAgainAndAgain(page: Page, presses: number): Promise<readonly number[]> {
  const pressedMs = await page.evaluateHandle(() => {
    const times: number[] = [];
    const note = ({ timeStamp }: Event) => times.push(performance.timeOrigin + timeStamp);
    window.addEventListener('pointerdown', note, { capture: true });
    return times;
  });
  const resume = page.getByRole('button', { name: 'Resume' });
  await page.getByRole('button', { name: 'Stop', exact: true }).hover();
  for (let press = 0; press < presses; press += 1) {
    await page.waitForTimeout(PAUSE_MS.shortest + Math.random() * (PAUSE_MS.longest - PAUSE_MS.shortest));
    await page.mouse.down();
    await page.mouse.up();
    await resume.waitFor();
    await page.waitForTimeout(SEQUENCE_MS);
    // The pointer stays on STOP.
    await resume.evaluate((button: HTMLElement) => button.click());
    await resume.waitFor({ state: 'hidden' });
  }
  return pressedMs.jsonValue();
}

/** Runs in the page: moves every slider at each frame, as ten fingers would. */
function dragInPage(sliders: readonly (HTMLElement | SVGElement)[]): void {
  let frame = 0;
  const move = (): void => {
    frame += 1;
    for (const slider of sliders as HTMLInputElement[]) {
      slider.value = String(1_500 + Math.round(400 * Math.sin(frame / 20)));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }
    requestAnimationFrame(move);
  };
  move();
}
