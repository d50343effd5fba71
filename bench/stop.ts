// From the press on STOP in the real page to the first stop byte at the board's pins, over gateway and pty at 9600 baud:
// what the person's finger meets. In two states: nothing else goes on, and all sliders are dragged at once.
//
// The press is the browser's own time of the pointer event, the byte is in the bus log; both count from the epoch. Beside
// it stands what the wire alone costs: a packet that has begun to leave cannot be recalled, and the board needs its gap.

import type { Page } from '@playwright/test';
import { family } from '#shared/protocol/families.ts';
import { wireMs } from '#shared/protocol/packet.ts';
import { packetsInto, type BusPacket } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { openDashboard, withBoard, withPage, type BoardOnPort } from './station.ts';
import { percentile } from './statistics.ts';

const PRESSES = 100;
/** Between Resume and the next press: at any moment of the packet on the wire, whose cycle is about 36 ms. */
const PAUSE_MS = { shortest: 60, longest: 110 };
/** A stop goes out at 0, 70 and 140 ms, then the hold. */
const SEQUENCE_MS = 220;
const STOPS_PER_PRESS = 3;
const GAP_MS = family('doc').serviceGapMs;

interface Outcome {
  readonly p99Ms: number;
  readonly wireMs: number;
}

export function measureStop(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await openDashboard(page, url);
      const idle = await outcomeOfPresses(page, board);
      await page.getByRole('slider').evaluateAll(dragInPage);
      return figuresOf({ idle, dragging: await outcomeOfPresses(page, board) });
    }),
  );
}

async function outcomeOfPresses(page: Page, board: BoardOnPort): Promise<Outcome> {
  const fromMs = Date.now();
  const pressedMs = await pressAgainAndAgain(page);
  return outcomeOf(pressedMs, packetsInto(board.readBusLog().filter(({ atMs }) => atMs >= fromMs)));
}

function figuresOf({ idle, dragging }: { idle: Outcome; dragging: Outcome }): Figure[] {
  const figure = (name: string, value: number, wireMs: number, note: string): Figure => ({
    ...{ key: `stop.${name}`, value, unit: 'ms', note },
    against: { what: 'wire alone', value: wireMs },
  });
  const worstMs = Math.max(idle.p99Ms, dragging.p99Ms);
  const longestMs = Math.max(idle.wireMs, dragging.wireMs);
  const aByte = `nothing on the wire but that byte; ${PRESSES} presses`;
  const aPacket = `at worst behind the longest packet and its gap; ${PRESSES} presses`;
  return [
    figure('idle.firstByteP99Ms', idle.p99Ms, idle.wireMs, aByte),
    figure('dragging.firstByteP99Ms', dragging.p99Ms, dragging.wireMs, aPacket),
    figure('firstByteP99Ms', worstMs, longestMs, 'the worst of these states beside the longest packet'),
  ];
}

/** Returns when each press was, in milliseconds since the epoch. */
async function pressAgainAndAgain(page: Page): Promise<readonly number[]> {
  const pressedMs = await page.evaluateHandle(() => {
    const times: number[] = [];
    const note = ({ timeStamp }: Event) => times.push(performance.timeOrigin + timeStamp);
    window.addEventListener('pointerdown', note, { capture: true });
    return times;
  });
  const resume = page.getByRole('button', { name: 'Resume' });
  await page.getByRole('button', { name: 'Stop', exact: true }).hover();
  for (let press = 0; press < PRESSES; press += 1) {
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

/** Throws unless exactly one sequence of stops follows each press: then each first byte belongs to its press. */
function outcomeOf(pressedMs: readonly number[], packets: readonly BusPacket[]): Outcome {
  const stops = packets.filter(({ command }) => command.kind === 'stop');
  const latencies = pressedMs.map((atMs, press) => {
    const untilMs = pressedMs[press + 1] ?? Infinity;
    const mine = stops.filter(({ firstByteMs }) => firstByteMs > atMs && firstByteMs < untilMs);
    const [first] = mine;
    if (first === undefined || mine.length !== STOPS_PER_PRESS)
      throw new Error(`${mine.length} stops followed press ${press + 1} of ${pressedMs.length}`);
    return first.firstByteMs - atMs;
  });
  const ahead = packets.some(({ command }) => command.kind === 'move')
    ? wireMs(Math.max(...packets.map(({ byteCount }) => byteCount))) + GAP_MS
    : 0;
  return { p99Ms: percentile(latencies, 99), wireMs: ahead + wireMs(1) };
}
