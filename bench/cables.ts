// A board on its own USB cable (HID) and one behind a Bluetooth module, each at the gateway and beside the same board on a serial port:
// a question and its answer, the age of slider values, and STOP while sliders are dragged. All parts are real but two, which take their
// own time on top: the USB interval (unpublished; 1 to 10 ms in similar firmware), and the radio, up to a connection interval (7.5 to 60 ms) each way.

import type { Page } from '@playwright/test';
import { bluezProblem, umockdevProblem } from '../scripts/browser.mjs';
import { say } from '../scripts/steps.mjs';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { slowest, tripsThroughPage } from './relay.ts';
import {
  withBluetoothBoard,
  withBoard,
  withDashboard,
  withHidBoard,
  withPage,
  type BoardOnPort,
} from './station.ts';
import { percentile } from './statistics.ts';
import { stopsWhileDragging } from './stop.ts';

const TRIPS = amount(30, 12);
const PRESSES = amount(10, 3);
const DRAG_MS = amount(1_200, 800);
/** First moves of six servos, one after another. */
const FIRST_MOVES_MS = 3_500;
/** What waits behind the last event has left by then. */
const CALM_MS = 500;

export async function measureBluetooth(): Promise<Figure[]> {
  const problem = bluezProblem();
  if (problem !== null) {
    say(`no figures of Bluetooth: ${problem}`);
    return [];
  }
  return beside('bluetooth', withBluetoothBoard, 'page, gateway, bleak, D-Bus, board and back; no radio');
}

export async function measureHid(): Promise<Figure[]> {
  const problem = umockdevProblem();
  if (problem !== null) {
    say(`no figures of HID: ${problem}`);
    return [];
  }
  return beside('hid', withHidBoard, 'page, gateway, hidraw node, board and back; no USB interval');
}

async function beside(name: string, lend: typeof withBoard, note: string): Promise<Figure[]> {
  const [trips, serialTrips] = [await tripsOn(lend), await serial.trips()];
  const { ages, stops } = await withDashboard(lend, async (page, board) => ({
    ages: await dragged(page, board),
    stops: await stopsWhileDragging(`${name}.stopDragging`, page, board, PRESSES),
  }));
  const serialAges = await serial.ages();
  return [
    ...[50, 99].map((percent) => ({
      ...{ key: `${name}.roundtripP${percent}Us`, value: slowest(trips, percent), unit: 'µs' },
      against: { what: 'serial', value: slowest(serialTrips, percent) },
      note,
    })),
    ...[50, 99].map((percent) => ({
      ...{ key: `${name}.dragP${percent}Ms`, value: percentile(ages, percent), unit: 'ms' },
      against: { what: 'serial', value: percentile(serialAges, percent) },
      note: `all sliders dragged once a frame, ${ages.length} packets; age of a value at its last byte`,
    })),
    ...stops,
  ];
}

/** Measured once a run, for each cable to stand beside. */
const serial = { trips: once(() => tripsOn(withBoard)), ages: once(() => withDashboard(withBoard, dragged)) };

function once<Value>(measure: () => Promise<Value>): () => Promise<Value> {
  let measured: Promise<Value> | undefined;
  return () => (measured ??= measure());
}

function tripsOn(lend: typeof withBoard): Promise<readonly number[]> {
  return lend(['--baud', '0'], ({ device }) =>
    withPage(device, (page, url) => tripsThroughPage(page, url, TRIPS)),
  );
}

/** Ages of the values of one drag. */
async function dragged(page: Page, board: BoardOnPort): Promise<readonly number[]> {
  await page.getByRole('slider').evaluateAll(dragOnce);
  await page.waitForTimeout(FIRST_MOVES_MS);
  return agesOf(board, await drag(page));
}

/** When each position was set, by position. */
async function drag(page: Page): Promise<ReadonlyMap<number, number>> {
  const events = await page.getByRole('slider').evaluateAll(dragInPage, DRAG_MS);
  await page.waitForTimeout(CALM_MS);
  return new Map(events);
}

function agesOf(board: BoardOnPort, setAtMs: ReadonlyMap<number, number>): readonly number[] {
  const ages = packetsInto(board.readBusLog()).flatMap(({ command, endMs }) => {
    if (command.kind !== 'move') return [];
    const atMs = setAtMs.get(command.targets[0]?.position ?? NaN);
    return atMs === undefined ? [] : [endMs - atMs];
  });
  if (ages.length === 0) throw new Error('no slider value reached the board');
  return ages;
}

/** Runs in the page, as the next one. */
function dragOnce(sliders: readonly (HTMLElement | SVGElement)[]): void {
  for (const slider of sliders as HTMLInputElement[]) {
    slider.value = '1000';
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }
}

/** Each frame sets a position of its own, so that a packet tells the event that it comes from. */
function dragInPage(
  sliders: readonly (HTMLElement | SVGElement)[],
  dragMs: number,
): Promise<readonly (readonly [position: number, atMs: number])[]> {
  const events: [number, number][] = [];
  const startMs = performance.now();
  return new Promise((resolve) => {
    const move = (): void => {
      const nowMs = performance.now();
      if (nowMs - startMs > dragMs) {
        resolve(events);
        return;
      }
      const position = 1_001 + events.length;
      events.push([position, performance.timeOrigin + nowMs]);
      for (const slider of sliders as HTMLInputElement[]) {
        slider.value = String(position);
        slider.dispatchEvent(new Event('input', { bubbles: true }));
      }
      requestAnimationFrame(move);
    };
    move();
  });
}
