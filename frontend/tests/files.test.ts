// Groups from the vendors' programs: opened, looked at, undone, saved, and read back the same; a broken file tells where and why.

import { vi } from 'vitest';
import * as group from '../../e2e/fixtures/group.ts';
import * as library from '../../e2e/fixtures/library.ts';
import * as timeline from '../../e2e/fixtures/timeline.ts';
import { fileOf, filesDialogOf, textOf, vector } from './filesDialog.ts';
import { dashboardOf, expect, here, test, type Dashboard } from './harness/test.ts';

const { captureGroup } = here(group);
const { libraryOf } = here(library);
const { timelineOf } = here(timeline);

/** What a person reads of each frame. */
const framesOf = (dashboard: Dashboard) =>
  dashboard.frames
    .getByRole('button', { name: /^Frame / })
    .evaluateAll((faces) => faces.map((face) => face.getAttribute('aria-label')));

test('a vendor’s XML becomes frames in one step, and saved as XML it is read back the same', async ({
  dashboard,
}) => {
  const files = filesDialogOf(dashboard);
  await files.open(await vector('No.10 wave.xml'));
  const wave = files.file('No.10 wave.xml');
  await expect(wave).toContainText('4 frames, 2.6 sec, 6 servos, for slot 10');
  const take = wave.getByRole('button', { name: 'Open wave' });
  // The file says no unit; its numbers leave no choice.
  await expect(wave.getByRole('button', { name: /^Pulse widths/ })).toHaveAttribute('aria-pressed', 'true');
  await take.click();

  await expect(files.dialog).toBeHidden();
  await expect(dashboard.frames).toHaveCount(4);
  await expect(dashboard.frame(2)).toHaveAccessibleName('Frame 2, 400 ms, moves servos 3 and 6');
  const frames = await framesOf(dashboard);
  await dashboard.button('Undo: open wave').click();
  await expect(dashboard.frames).toHaveCount(0);
  await dashboard.button('Redo: open wave').click();

  const saved = await files.save('XML');
  expect(saved.name).toBe('10 wave.xml');
  await files.open({ ...saved, name: 'again.xml' });
  await files.file('again.xml').getByRole('button', { name: 'Open again' }).click();
  await expect(dashboard.field('Name of the group')).toHaveValue('again');
  expect(await framesOf(dashboard)).toEqual(frames);
});

test('a .d6a database is opened and saved by the page alone', async ({ dashboard }) => {
  const files = filesDialogOf(dashboard);
  await files.open(await vector('greet.d6a'));
  const greet = files.file('greet.d6a');
  await greet.getByRole('button', { name: /^Pulse widths/ }).click();
  await greet.getByRole('button', { name: 'Open greet' }).click();
  await expect(dashboard.frames).toHaveCount(3);
  const saved = await files.save('.d6a');
  expect(saved.name).toBe('greet.d6a');
  expect(textOf(saved).slice(0, 15)).toBe('SQLite format 3');
  await files.open({ ...saved, name: 'back.d6a' });
  await expect(files.file('back.d6a')).toContainText('3 frames, 1.6 sec, 3 servos');
});

test('several files come at once; a broken one tells where and why, and changes nothing', async ({
  dashboard,
  page,
}) => {
  await captureGroup(dashboard, [1000, 1200]);
  const files = filesDialogOf(dashboard);
  const broken = textOf(await vector('nod.xml')).replace('P1900', 'P19.0');
  await files.open(await vector('secret.rob'), fileOf('broken.xml', broken), await vector('step.rob'));
  await expect(files.file('broken.xml')).toContainText('broken.xml was not opened.');
  await expect(files.file('broken.xml')).toContainText('Line 8: “19.0” is not a position');
  await expect(files.file('secret.rob')).toContainText('It is encrypted.');
  await expect(files.file('step.rob')).toContainText('It is made for boards that use another unit.');
  await files.file('broken.xml').getByRole('button', { name: 'Remove broken.xml from the list' }).click();
  await expect(files.file('broken.xml')).toBeHidden();
  // Turned or made smaller, the window has other panels; what was opened stays.
  await page.setViewportSize({ width: 820, height: 900 });
  await expect(files.file('secret.rob')).toBeVisible();
  await dashboard.button('Close').click();
  await expect(dashboard.frames).toHaveCount(2);
  await expect(dashboard.button('Files, 1 opened, 1 not opened')).toBeVisible();
});

test('several groups are taken in one go: one is shown, the others are in the library', async ({
  dashboard,
  page,
}) => {
  const files = filesDialogOf(dashboard);
  const { content } = await vector('nod.xml');
  await files.open(
    { name: 'all one.xml', content },
    { name: 'all two.xml', content },
    await vector('secret.rob'),
  );
  await expect(files.file('secret.rob')).toContainText('It is encrypted.');
  await files.dialog.getByRole('button', { name: 'Open all 2' }).click();
  await expect(dashboard.field('Name of the group')).toHaveValue('all one');
  await expect(dashboard.button('Files, 1 not opened')).toBeVisible();
  const library = libraryOf(page);
  await library.show();
  await expect(library.card('all two')).toBeVisible();
});

test('files are read by a worker: how far it has come is said, and a cancel loses nothing', async ({
  dashboard,
}) => {
  await captureGroup(dashboard, [1000, 1200]);
  const files = filesDialogOf(dashboard);
  const unanswered = vi.spyOn(Worker.prototype, 'postMessage').mockReturnValue(undefined);
  const progress = files.dialog.getByRole('progressbar', { name: 'Reading files' });
  await files.open(await vector('nod.xml'), await vector('greet.d6a'), await vector('reach.csv'));
  await expect(progress).toHaveAttribute('aria-valuetext', '0 of 3 files read');
  await files.dialog.getByRole('button', { name: 'Cancel' }).click();
  await expect(files.dialog).toContainText('Cancelled. 3 files not read.');
  await expect(progress).toBeHidden();
  unanswered.mockRestore();
  await files.open(await vector('nod.xml'), await vector('greet.d6a'));
  await expect(files.file('nod.xml')).toContainText('2 frames');
  await expect(files.file('greet.d6a')).toContainText('3 frames');
  await expect(files.dialog).not.toContainText('not read');
  await dashboard.button('Close').click();
  await expect(dashboard.frames).toHaveCount(2);
});

test('what the board cannot do becomes no program, and says which servo and frame', async ({ dashboard }) => {
  const files = filesDialogOf(dashboard);
  const far = textOf(await vector('nod.xml')).replace('P1900', 'P2900');
  await files.open(fileOf('far.xml', far));
  await expect(files.file('far.xml')).toContainText('Servo 3 goes to 2900; it takes 500 to 2500. Frame 2.');
  await files.file('far.xml').getByRole('button', { name: 'Open far' }).click();
  await dashboard.button('Files').click();
  await files.dialog.getByRole('radio', { name: 'Python' }).check();
  await files.dialog.getByRole('button', { name: 'Save far.py' }).click();
  await expect(files.dialog.getByRole('status')).toContainText('Servo 3 goes to 2900');
});

test('files dropped anywhere on the panel are opened; beside it a drop does nothing', async ({
  dashboard,
  page,
}) => {
  const text = textOf(await vector('nod.xml'));
  const carried = new DataTransfer();
  carried.items.add(new File([text], 'nod.xml'));
  await page.getByRole('banner').dispatchEvent('drop', { dataTransfer: carried });
  await expect(filesDialogOf(dashboard).dialog).toBeHidden();
  await page.getByRole('region', { name: 'Action group' }).dispatchEvent('drop', { dataTransfer: carried });
  await expect(filesDialogOf(dashboard).file('nod.xml')).toContainText('2 frames, 0.8 sec, 6 servos');
});

test.describe('with a board that says nothing', () => {
  test.override({ boardSettings: { faults: ['droppedByte=1'] } });

  test('where no board is known the robot’s own counts: files are judged by it and programs are written for it', async ({
    page,
    robot,
  }) => {
    await robot.open({ isKnown: false });
    const dashboard = dashboardOf(page);
    await expect(dashboard.link).not.toContainText('Ready');
    const files = filesDialogOf(dashboard);
    await files.open(await vector('nod.xml'));
    const nod = files.file('nod.xml');
    await expect(nod).toContainText('2 frames, 0.8 sec, 6 servos');
    await expect(nod).not.toContainText('the board takes');
    await expect(nod).not.toContainText('does not exist there');
    await nod.getByRole('button', { name: 'Open nod' }).click();
    expect(textOf(await files.save('Python'))).toContain('FRAMES = [');
    const sketch = await files.save('Arduino');
    expect(sketch.name).toMatch(/\.ino$/);
    expect(textOf(sketch)).toContain('void loop()');
  });
});

test.describe('on a board that counts in steps', () => {
  test.override({ boardSettings: { board: 'xarm' } });

  test('pulse widths become steps where the person says so, and only then', async ({ dashboard, page }) => {
    const files = filesDialogOf(dashboard);
    await files.open(await vector('nod.xml'));
    const nod = files.file('nod.xml');
    await expect(nod).toContainText('It is made for boards that use another unit.');
    const converts = nod.getByRole('switch', { name: /^Convert to steps/ });
    await expect(converts).not.toBeChecked();
    await converts.check();
    await expect(nod).not.toContainText('another unit');
    await nod.getByRole('button', { name: 'Open nod' }).click();
    const { key } = timelineOf(page);
    await expect(key('Gripper, 0.50 s, 100 steps, linear')).toBeVisible();
    await expect(key('Gripper, 0.75 s, 1000 steps, linear')).toBeVisible();
    await expect(dashboard.board).toContainText(/Fits/);

    await dashboard.button('Undo: open nod').click();
    await files.open(await vector('nod.xml'));
    await nod.last().getByRole('button', { name: 'Open nod' }).click();
    const question = page.getByText('Made for another board. Convert?');
    await expect(question).toBeVisible();
    await expect(dashboard.button('Play')).toBeDisabled();
    await expect(dashboard.boardBar).toContainText('For another board');
    await expect(dashboard.boardBar, 'what the slot holds').toContainText('Unknown');
    await expect(key('Gripper, 0.50 s, 700 µs, linear')).toBeVisible();
    const pictures = () =>
      dashboard.frames.evaluateAll((cards) =>
        cards.map((card) => [...card.querySelectorAll('svg path')].map((path) => path.getAttribute('d'))),
      );
    const ofPulseWidths = await pictures();
    await dashboard.button('Convert').click();
    await expect(question).toBeHidden();
    await expect(key('Gripper, 0.50 s, 100 steps, linear')).toBeVisible();
    expect(await pictures(), 'the same pose, counted otherwise').toEqual(ofPulseWidths);
    await expect(dashboard.button('Play')).toBeEnabled();
    await dashboard.button('Undo: convert for this board').click();
    await expect(question).toBeVisible();
  });
});
