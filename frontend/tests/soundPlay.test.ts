// The sound of a group beside its motion: what is heard at the moment a frame leaves for the board. The audio hardware is one under test.

import { ofKind } from '../../e2e/fixtures/bus.ts';
import * as e2e from '../../e2e/fixtures/timeline.ts';
import { createAudioUnderTest } from '../src/features/animate/sound/audioUnderTest.ts';
import { expect, here, test, type Dashboard } from './harness/test.ts';
import { advance, timeOriginMs, worldClock } from './harness/time.ts';
import type { Robot } from './harness/robot.ts';
import { metronome } from '#shared/testing/wav.ts';

const keepGroup = here(e2e.keepGroup);
const timelineOf = here(e2e.timelineOf);

const CLICKS = metronome({ bpm: 120, firstMs: 250, lengthMs: 12_000 });
const NEAR_MS = 20;

let audio = createAudioUnderTest(worldClock);

test.beforeEach(async ({ page }) => {
  audio = createAudioUnderTest(worldClock);
  window.AudioContext = new Proxy(window.AudioContext, { construct: () => audio.context });
  await keepGroup(page, [1000, 1200, 1400, 1600, 1800]);
});

async function addSound({ page }: Dashboard): Promise<void> {
  const choosing = page.waitForEvent('filechooser');
  await timelineOf(page).tools.getByRole('button', { name: 'More', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Add sound …' }).click();
  await (await choosing).setFiles({ name: 'march.wav', mimeType: 'audio/wav', buffer: CLICKS });
  await expect(page.getByRole('group', { name: 'Sound track' })).toContainText('120 bpm');
}

/** When the move of servo 1 to each position began to leave, on the page's clock, after `sinceMs`. */
async function leftAt({ bus }: Robot, sinceMs: number): Promise<readonly (readonly [number, number])[]> {
  return (await bus()).flatMap(({ command, beganAtMs }) => {
    const atMs = beganAtMs - timeOriginMs;
    const target = command.kind === 'move' && command.targets.find(({ servo }) => servo === 1);
    return target && atMs > sinceMs ? [[target.position, atMs] as const] : [];
  });
}

const now = (): number => worldClock.now();
/** Nothing sounds any more, as soon as the loudspeakers have said what they had. */
const silentSoon = (): void => expect(audio.heardAt(now() + 130)).toEqual([]);

test('each frame leaves when its place in the sound is heard, also where servos start one after another', async ({
  dashboard,
  robot,
}) => {
  await addSound(dashboard);
  const beganMs = now();
  await dashboard.button('Play').click();
  await expect(dashboard.button('Pause')).toBeVisible();
  await expect(dashboard.button('Play')).toBeVisible();
  const left = await leftAt(robot, beganMs);
  const frames = left.filter(([position]) => position > 1000);
  expect(frames.map(([position]) => position)).toEqual([1200, 1400, 1600, 1800]);
  for (const [index, [, atMs]] of frames.entries()) {
    const heard = audio.heardAt(atMs + 1);
    expect(heard).toHaveLength(1);
    expect(Math.abs((heard[0] ?? NaN) - 500 * (index + 1))).toBeLessThan(NEAR_MS);
  }
  // Its beginning, too, on the way to the first pose; and in one piece.
  expect(audio.heardAt((frames[0]?.[1] ?? NaN) - 450)).toHaveLength(1);
  expect(audio.given).toHaveLength(1);
  silentSoon();
});

test('at half the speed, in a loop, until it is paused', async ({ dashboard, page, robot }) => {
  await addSound(dashboard);
  await dashboard.type(page.getByRole('textbox', { name: 'Speed' }), 50);
  await page.getByRole('switch', { name: 'Loop' }).click();
  const beganMs = now();
  await dashboard.button('Play').click();
  await advance(14_000);
  const frames = (await leftAt(robot, beganMs)).filter(([position]) => position === 1600);
  expect(frames.length).toBeGreaterThan(1);
  for (const [, atMs] of frames) {
    const heard = audio.heardAt(atMs + 1);
    expect(heard).toHaveLength(1);
    expect(Math.abs((heard[0] ?? NaN) - 1500)).toBeLessThan(NEAR_MS);
  }
  expect(audio.given.every(({ rate }) => rate === 0.5)).toBe(true);
  await dashboard.button('Pause').click();
  silentSoon();
});

test('STOP silences it at once', async ({ dashboard, page }) => {
  await addSound(dashboard);
  await dashboard.button('Play').click();
  await advance(3000);
  expect(audio.heardAt(now())).toHaveLength(1);
  await page.keyboard.press('Escape');
  silentSoon();
  await expect(dashboard.resume).toBeVisible();
  silentSoon();
});

test('a preview has it from the playhead on, and moves nothing; scrubbing is silent', async ({
  dashboard,
  page,
  robot,
}) => {
  await addSound(dashboard);
  const before = ofKind(await robot.bus(), 'move').length;
  await timelineOf(page).grid.press('.');
  await timelineOf(page).grid.press('.');
  expect(audio.given).toEqual([]);
  const beganMs = now();
  await dashboard.button('Preview').click();
  await advance(600);
  const atMs = now();
  const [heard = NaN] = audio.heardAt(atMs);
  expect(heard).toBeGreaterThan(1000 + 500);
  expect(heard).toBeLessThan(1000 + (atMs - beganMs) + NEAR_MS);
  expect(ofKind(await robot.bus(), 'move')).toHaveLength(before);
});

test('run on the board it is heard from the moment the board began', async ({ dashboard, robot }) => {
  await addSound(dashboard);
  await dashboard.button('Run on board').click();
  await expect.poll(async () => ofKind(await robot.bus(), 'run').length).toBe(1);
  await advance(1500);
  const run = (await robot.bus()).find(({ command }) => command.kind === 'run');
  const ranMs = (run?.endedAtMs ?? NaN) - timeOriginMs;
  const [heard = NaN] = audio.heardAt(ranMs + 1200);
  expect(Math.abs(heard - 1200)).toBeLessThan(NEAR_MS);
});

test('taps on its beats give the tempo', async ({ dashboard, page }) => {
  await addSound(dashboard);
  const row = page.getByRole('group', { name: 'Sound track' });
  await row.getByRole('button', { name: 'Sound', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Tap tempo' }).click();
  const tap = row.getByRole('button', { name: 'Tap', exact: true });
  await expect(tap).toBeFocused();
  await advance(480);
  for (let taps = 0; taps < 6; taps += 1) {
    const beganMs = now();
    await tap.press(' ');
    await advance(576 - (now() - beganMs));
  }
  await expect(row).toContainText('104 bpm');
  await row.getByRole('button', { name: 'Use' }).click();
  await expect(row.getByRole('slider')).toBeVisible();
  await expect(row).toContainText('104 bpm');
  silentSoon();
  await dashboard.button('Undo: beats').click();
  await expect(row).toContainText('120 bpm');
});
