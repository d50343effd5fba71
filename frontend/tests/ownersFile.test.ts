// What all of it is for: an owner of a vendor's file opens it, improves it, sees that it fits, downloads it, and the board plays exactly
// what the preview showed.

import { compile } from '#shared/group/compile.ts';
import { totalDurationMs, type ActionGroup, groupFromText } from '#shared/group/group.ts';
import { positionAt, tracksOf, type Track } from '#shared/group/tracks.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { createBoard } from '#shared/simulator/board.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { ofKind, type Heard } from '../../e2e/fixtures/bus.ts';
import * as timelines from '../../e2e/fixtures/timeline.ts';
import { filesDialogOf, textOf, vector } from './filesDialog.ts';
import { expect, here, poll, test } from './harness/test.ts';

const { timelineOf } = here(timelines);

const TICK_MS = 20;
/** As the board panel offers it at first, with the rounding to whole positions. */
const BOUND = 5.5;
/** The board takes a frame at a tick of its own, after it has read the command. */
const AROUND_MS = 3 * TICK_MS;

test('a vendor’s file is opened, improved with curves and undo, fits, and the board plays what the preview showed', async ({
  dashboard,
  page,
  robot,
}) => {
  const files = filesDialogOf(dashboard);
  await files.open(await vector('No.10 wave.xml'));
  const wave = files.file('No.10 wave.xml');
  await wave.getByRole('button', { name: /^Pulse widths/ }).click();
  await wave.getByRole('button', { name: 'Open wave' }).click();
  await expect(dashboard.frames).toHaveCount(4);
  await expect(dashboard.slot).toHaveValue('10');

  const timeline = timelineOf(page);
  await timeline.grid.press('Control+a');
  await timeline.tools.getByRole('combobox', { name: 'Easing' }).selectOption('ease in and out');
  await expect(timeline.key('Base, 1.40 s, 1200 µs, ease in and out')).toBeVisible();
  await timeline.grid.press('Delete');
  await dashboard.button(/^Undo: delete/).click();
  await timeline.click('Base, 1.40 s, 1200 µs, ease in and out');
  await page.keyboard.type('1100');
  await page.keyboard.press('Enter');
  await expect(timeline.key('Base, 1.40 s, 1100 µs, ease in and out')).toBeVisible();
  await dashboard.button('Undo: position of keys').click();
  await dashboard.button('Redo: position of keys').click();
  await expect(dashboard.board).toContainText(/Fits\s*\d+ of 255 frames/);

  await dashboard.button('Download').click();
  await expect(dashboard.notices).toContainText('Slot 10 is downloaded.');
  await dashboard.button('Run').click();
  await poll(async () => ofKind(await robot.bus(), 'run')).toEqual([{ kind: 'run', slot: 10, times: 1 }]);
  await expect(dashboard.status).toHaveText('Idle', { timeout: 20_000 });

  const saved = await files.save('Servodeck');
  const group = groupIn(textOf(saved));
  const bus = await robot.bus();
  const stored = ofKind(bus, 'download').map(({ frame }) => frame);
  expect(stored).toEqual(compile(group, { family: FAMILIES.doc, maxErrorUnits: 5 }).frames);
  expect(stored.length).toBeGreaterThan(group.frames.length);

  const places = await played(bus, totalDurationMs(group.frames));
  const seen = [...tracksOf(group).values()].flatMap((track) =>
    places.map(({ atMs, pulse }) => [pulse(track.servo), ...previewed(track, atMs)] as const),
  );
  for (const [pulse, least, most] of seen) {
    expect(pulse).toBeGreaterThanOrEqual(least - BOUND);
    expect(pulse).toBeLessThanOrEqual(most + BOUND);
  }
  expect(new Set(places.map(({ pulse }) => pulse(6))).size).toBeGreaterThan(20);
});

function groupIn(text: string): ActionGroup {
  const read = groupFromText(text);
  if ('problem' in read) throw new Error(read.problem.code);
  return read.value;
}

interface Instant {
  /** Since the group began. */
  readonly atMs: number;
  readonly pulse: (servo: number) => number;
}

/** What that board heard, on a board in virtual time that one can look at; from where its servos have come to the first frame. */
async function played(heard: readonly Heard[], lengthMs: number): Promise<readonly Instant[]> {
  const clock = createVirtualClock();
  const board = createBoard({ clock, send: () => undefined });
  const stored = ofKind(heard, 'download');
  for (const { command } of heard.filter(({ command: { kind } }) => kind === 'download' || kind === 'run')) {
    board.receive(encodeCommand(command, FAMILIES.doc));
    await clock.advance(command.kind === 'run' ? TICK_MS : 500);
  }
  const firstMs = stored[0]?.frame.durationMs ?? 0;
  const places: Instant[] = [];
  for (let atMs = TICK_MS; atMs < lengthMs; atMs += TICK_MS) {
    const { pulses } = board.snapshot();
    if (atMs > firstMs + AROUND_MS) places.push({ atMs, pulse: (servo) => pulses[servo - 1] ?? NaN });
    await clock.advance(TICK_MS);
  }
  return places;
}

/** Lowest and highest place that the preview shows around an instant. */
function previewed(track: Track, atMs: number): readonly [number, number] {
  const places = [];
  for (let ms = atMs - AROUND_MS; ms <= atMs + AROUND_MS; ms += 5) places.push(positionAt(track, ms) ?? NaN);
  return [Math.min(...places), Math.max(...places)];
}
