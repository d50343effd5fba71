// How far the sound of a group is from its motion: what is heard of it when the first byte of a frame is at the board's pins, over many starts
// in a real browser, over gateway and pty. What the page gave to the audio hardware is noted, and the hardware's clock beside the page's.

import type { Page } from '@playwright/test';
import { emptyGroup, groupToText } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { metronome } from '#shared/testing/wav.ts';
import { amount } from './amounts.ts';
import { packetsInto } from './busPackets.ts';
import type { Figure } from './figure.ts';
import { openDashboard, withBoard, withPage } from './station.ts';
import { percentile } from './statistics.ts';

const STARTS = amount(10, 2);
const LIMIT_MS = 20;
const FRAME_MS = 500;
/** Of servo 1, by which a frame is known on the bus. */
const POSITIONS = [1000, 1100, 1200];
const GROUP = groupToText(
  POSITIONS.reduce(
    (group, position, index) =>
      insertFrame(group, index, { durationMs: FRAME_MS, targets: [{ servo: 1, position }] }),
    emptyGroup('Wave', 'us'),
  ),
);
const LOG_LAG_MS = 300;

interface Given {
  readonly atMs: number;
  readonly beginS: number;
  readonly offsetS: number;
  endS: number;
}

/** The hardware plays `contextS` of its own time at `atMs`, on the wall clock. */
interface Clocks {
  readonly atMs: number;
  readonly contextS: number;
}

interface Noted {
  readonly given: readonly Given[];
  readonly clocks: readonly Clocks[];
}

declare global {
  interface Window {
    soundNoted: { given: Given[]; clocks: Clocks[] };
  }
}

export function measureSound(): Promise<Figure[]> {
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      await page.addInitScript(noteSound);
      await page.addInitScript((text) => localStorage.setItem('servodeck.group', text), GROUP);
      await openDashboard(page, url);
      await addSound(page);
      const beganMs = Date.now();
      for (let start = 0; start < STARTS; start += 1) await play(page);
      await page.waitForTimeout(LOG_LAG_MS);
      const noted = await page.evaluate(() => window.soundNoted);
      const frames = packetsInto(board.readBusLog()).flatMap(({ command, firstByteMs }) => {
        const target = command.kind === 'move' && command.targets.find(({ servo }) => servo === 1);
        const index = target ? POSITIONS.indexOf(target.position) : -1;
        return firstByteMs > beganMs && index > 0 ? [{ atMs: firstByteMs, groupMs: index * FRAME_MS }] : [];
      });
      return figuresOf(frames.map(({ atMs, groupMs }) => Math.abs(heardAt(noted, atMs) - groupMs)));
    }),
  );
}

function figuresOf(offMs: readonly number[]): Figure[] {
  const wanted = STARTS * (POSITIONS.length - 1);
  if (offMs.length < wanted || offMs.some(Number.isNaN))
    throw new Error(`${offMs.filter((off) => !Number.isNaN(off)).length} of ${wanted} frames had a sound`);
  const note = `between sound and motion, ${STARTS} starts of ${POSITIONS.length} frames, over the gateway`;
  return [50, 99, 100].map((percent) => ({
    ...{ key: `sound.offsetP${percent}Ms`, value: percentile(offMs, percent), unit: 'ms', note },
    ...(percent === 99 && { limit: { atMost: LIMIT_MS } }),
  }));
}

async function addSound(page: Page): Promise<void> {
  const choosing = page.waitForEvent('filechooser');
  await page
    .getByRole('toolbar', { name: 'Change the timeline' })
    .getByRole('button', { name: 'More', exact: true })
    .click();
  await page.getByRole('menuitem', { name: 'Add sound …' }).click();
  const buffer = Buffer.from(metronome({ bpm: 120, firstMs: 0, lengthMs: 10_000 }));
  await (await choosing).setFiles({ name: 'beats.wav', mimeType: 'audio/wav', buffer });
  await page.getByRole('group', { name: 'Sound track' }).getByText('120 bpm').waitFor();
}

async function play(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  await page.getByRole('button', { name: 'Play', exact: true }).waitFor();
}

/** Where in the sound one is by ear; NaN: it is silent. */
function heardAt({ given, clocks }: Noted, atMs: number): number {
  // One look at the two clocks is off by a block of samples.
  const zeros = clocks
    .filter((clock) => Math.abs(clock.atMs - atMs) < 1000)
    .map((clock) => clock.atMs - clock.contextS * 1000);
  const contextS = (atMs - percentile(zeros, 50)) / 1000;
  const sounding = given.findLast(({ beginS, endS }) => contextS >= beginS && contextS < endS);
  return sounding === undefined ? NaN : (sounding.offsetS + contextS - sounding.beginS) * 1000;
}

/** Runs in the page, before its own code. */
function noteSound(): void {
  const noted: Window['soundNoted'] = { given: [], clocks: [] };
  window.soundNoted = noted;
  const latest = new WeakMap<object, Given>();
  const { start, stop } = AudioBufferSourceNode.prototype;
  AudioBufferSourceNode.prototype.start = function (beginS = 0, offsetS = 0) {
    const one = { atMs: Date.now(), beginS, offsetS, endS: Infinity };
    noted.given.push(one);
    latest.set(this, one);
    start.call(this, beginS, offsetS);
  };
  AudioBufferSourceNode.prototype.stop = function (endS = 0) {
    const one = latest.get(this);
    if (one !== undefined) one.endS = Math.min(one.endS, endS);
    stop.call(this, endS);
  };
  window.AudioContext = class extends AudioContext {
    constructor(options?: AudioContextOptions) {
      super(options);
      setInterval(() => {
        const { contextTime = 0, performanceTime = 0 } = this.getOutputTimestamp();
        if (performanceTime > 0)
          noted.clocks.push({ atMs: performance.timeOrigin + performanceTime, contextS: contextTime });
      }, 20);
    }
  };
}
