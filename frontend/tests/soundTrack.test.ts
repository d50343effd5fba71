// A sound beside the keys: added, drawn, moved, snapped to, missing on another computer, and removed.

import * as e2e from '../../e2e/fixtures/timeline.ts';
import { expectSound } from './harness/sound.ts';
import { expect, here, test, type Dashboard } from './harness/test.ts';
import { metronome } from '#shared/testing/wav.ts';

const keepGroup = here(e2e.keepGroup);
const timelineOf = here(e2e.timelineOf);

/** 120 beats a minute, the first one after 250 ms. */
const CLICKS = metronome({ bpm: 120, firstMs: 250, lengthMs: 12_000 });

function soundIn(dashboard: Dashboard) {
  const { page } = dashboard;
  const row = page.getByRole('group', { name: 'Sound track' });
  const menu = page.getByRole('menu', { name: 'Sound', exact: true });
  async function give(name: string, buffer: Uint8Array, press: () => Promise<void>): Promise<void> {
    const choosing = page.waitForEvent('filechooser');
    await press();
    await (await choosing).setFiles({ name, mimeType: 'audio/wav', buffer });
  }
  return {
    ...{ row, give },
    start: row.getByRole('slider', { name: 'Start of the sound' }),
    async add(name: string, buffer: Uint8Array): Promise<void> {
      await timelineOf(page).tools.getByRole('button', { name: 'More', exact: true }).click();
      await give(name, buffer, () => page.getByRole('menuitem', { name: 'Add sound …' }).click());
    },
    async choose(name: string): Promise<void> {
      await row.getByRole('button', { name: 'Sound', exact: true }).click();
      await menu.getByRole('menuitem', { name, exact: true }).click();
    },
    /** The shares of the row's picture that are drawn: of its upper part with the beats, of its lower one with the waves. */
    drawn: (): Promise<readonly number[]> =>
      row
        .locator('canvas')
        .first()
        .evaluate((canvas) => {
          if (!(canvas instanceof HTMLCanvasElement)) return [];
          const beats = Math.round(canvas.height * (7 / 44));
          const ctx = canvas.getContext('2d');
          return [
            [0, beats],
            [beats + 3, canvas.height - beats - 3],
          ].map(([from = 0, height = 0]) => {
            const { data } = ctx?.getImageData(0, from, canvas.width, height) ?? { data: [] };
            const colours = new Map<number, number>();
            for (let at = 0; at < data.length; at += 4) {
              const colour = ((data[at] ?? 0) << 16) | ((data[at + 1] ?? 0) << 8) | (data[at + 2] ?? 0);
              colours.set(colour, (colours.get(colour) ?? 0) + 1);
            }
            const [usual = 0] = [...colours.values()].toSorted((one, other) => other - one);
            return 1 - usual / Math.max(1, data.length / 4);
          });
        }),
  };
}

test.beforeEach(async ({ page }) => {
  await keepGroup(page);
});

test('a sound is added with its beats, drawn, and taken away by undo', async ({ dashboard, page }) => {
  const sound = soundIn(dashboard);
  await expect(sound.row).toBeHidden();
  await sound.add('march.wav', CLICKS);
  await expect(sound.row).toContainText('march.wav');
  await expect(sound.row).toContainText('120 bpm');
  await expect.poll(async () => (await sound.drawn()).map((share) => share > 0.001)).toEqual([true, true]);
  await expectSound('a sound track');
  await dashboard.button('Undo: add sound').click();
  await expect(sound.row).toBeHidden();
  await dashboard.button('Redo: add sound').click();
  await expect(sound.row).toContainText('120 bpm');
  await page.reload();
  await expect(sound.row).toContainText('march.wav');
  await expect.poll(async () => (await sound.drawn()).map((share) => share > 0.001)).toEqual([true, true]);
});

test('it is moved by hand and by keys, each in one step', async ({ dashboard, page }) => {
  const sound = soundIn(dashboard);
  await sound.add('march.wav', CLICKS);
  await expect(sound.start).toHaveAttribute('aria-valuetext', 'march.wav, starts at 0.00 s');
  await sound.start.press('ArrowRight');
  await expect(sound.start).toHaveAttribute('aria-valuetext', 'march.wav, starts at 0.02 s');
  await sound.start.press('Shift+ArrowLeft');
  await expect(sound.start).toHaveAttribute('aria-valuenow', '-180');
  await dashboard.button('Undo: move sound').click();
  await expect(sound.start).toHaveAttribute('aria-valuenow', '20');
  const { x, y } = await timelineOf(page).middleOf(sound.start);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 80, y, { steps: 8 });
  await page.mouse.up();
  await expect(sound.start).toHaveAttribute('aria-valuenow', /^[2-9]\d\d$/);
  await dashboard.button('Undo: move sound').click();
  await expect(sound.start).toHaveAttribute('aria-valuenow', '20');
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 80, y, { steps: 8 });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await expect(sound.start).toHaveAttribute('aria-valuenow', '20');
});

test('a key that is dragged near a beat comes to rest on it, and says which one it is', async ({
  dashboard,
  page,
}) => {
  const sound = soundIn(dashboard);
  const timeline = timelineOf(page);
  await sound.add('march.wav', CLICKS);
  await expect(sound.row).toContainText('120 bpm');
  const one = await timeline.middleOf(timeline.key('Gripper, 1.00 s, 1200 µs, linear'));
  const next = await timeline.middleOf(timeline.key('Gripper, 1.50 s, 1400 µs, linear'));
  await timeline.drag('Gripper, 1.00 s, 1200 µs, linear', (next.x - one.x) / 2 + 3, 0);
  await expect(timeline.region).toContainText('beat 3');
  await page.mouse.up();
  // On the beat: the board's raster would be 1.24 or 1.26 s.
  await expect(timeline.grid.getByRole('gridcell', { name: /^Gripper, 1\.25\d? s, 1200 µs/ })).toBeVisible();
});

test('the tempo is halved and doubled, the beats are removed and found again, the sound is removed', async ({
  dashboard,
}) => {
  const sound = soundIn(dashboard);
  await sound.add('march.wav', CLICKS);
  await sound.choose('Half tempo');
  await expect(sound.row).toContainText('60 bpm');
  await sound.choose('Double tempo');
  await expect(sound.row).toContainText('120 bpm');
  await sound.choose('Remove beats');
  await expect(sound.row).toContainText('No beats');
  await sound.choose('Find beats');
  await expect(sound.row).toContainText('120 bpm');
  await sound.choose('Mute on this computer');
  await expect(sound.row).toContainText('Muted here');
  await sound.choose('Remove sound');
  await expect(sound.row).toBeHidden();
  await dashboard.button('Undo: remove sound').click();
  await expect(sound.row).toContainText('Muted here');
});

test('on another computer it says which file is missing, and takes it', async ({ dashboard, page }) => {
  const sound = soundIn(dashboard);
  await sound.add('march.wav', CLICKS);
  await expect(sound.row).toContainText('120 bpm');
  await new Promise<void>((resolve) => {
    indexedDB.deleteDatabase('servodeck-files').addEventListener('success', () => resolve());
  });
  await page.reload();
  await expect(sound.row).toContainText('march.wav is not on this computer.');
  await sound.give('noise.wav', Uint8Array.of(1, 2, 3), () =>
    sound.row.getByRole('button', { name: 'Choose file …' }).click(),
  );
  await expect(page.getByText('noise.wav cannot be read.')).toBeVisible();
  await sound.give('renamed.wav', CLICKS, () =>
    sound.row.getByRole('button', { name: 'Choose file …' }).click(),
  );
  await expect(sound.start).toBeVisible();
  // The very file: nothing of the group has changed.
  await expect(sound.row).toContainText('march.wav');
  await expect(dashboard.button('Undo')).toBeDisabled();
});

test('a sound that is dropped on the timeline is added', async ({ dashboard, page }) => {
  const sound = soundIn(dashboard);
  await timelineOf(page).region.evaluate((region, bytes) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([bytes.slice()], 'dropped.wav', { type: 'audio/wav' }));
    region.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  }, CLICKS);
  await expect(sound.row).toContainText('dropped.wav');
  await expect(page.getByRole('dialog')).toBeHidden();
});
