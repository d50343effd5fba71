import { describe, expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { createTestPage } from '../pageUnderTest.ts';
import { createFilm, FILM } from './film.ts';

const STEP_MS = 20;
const LEAD_MS = 1500;
const SIZE = { width: 640, height: 480 };
/** Stands for a picture: the fake encoder writes what is drawn at that moment. */
const CANVAS = {} as CanvasImageSource;

/** A page whose camera shows at each instant how often it was looked at, with pictures of so many bytes. */
async function filmed({ lengthMs = 2000, bytes = 1000, everyMs = STEP_MS } = {}) {
  const page = await createTestPage();
  const { document, opened, playback, playhead, draw } = page;
  document.edit(
    () => 'write',
    (group) =>
      [500, lengthMs - 500].reduce(
        (sum, durationMs, index) =>
          insertFrame(sum, index, { durationMs, targets: [{ servo: 1, position: 1000 + 400 * index }] }),
        emptyGroup(group.name, 'us'),
      ),
  );
  let shown = 0;
  const film = createFilm({ playback, playhead, library: { store: opened } }, () => {
    shown += 1;
    return Promise.resolve(new Blob([`${shown} `.padEnd(bytes, 'x')]));
  });
  return {
    ...page,
    film,
    state: () => film.store.getState(),
    /** Which picture it was. */
    at: async (atMs: number) => Number.parseInt((await film.at(atMs)?.jpeg.text()) ?? 'NaN'),
    async run(ms: number) {
      for (let passed = 0; passed < ms; passed += everyMs) {
        await draw(everyMs);
        await film.take(CANVAS, SIZE);
      }
    },
  };
}

describe('the film of a motion', () => {
  test('has a picture for each moment of the motion, none of the way there, and is shown afterwards', async () => {
    const { film, playback, run, state, at } = await filmed();
    film.set(true);
    await run(300);
    playback.play();
    await run(LEAD_MS - 100);
    expect(state().count).toBe(0);
    await run(2200);
    expect(state()).toMatchObject({ isFilming: false, isShown: true, isFull: false });
    expect(state().count).toBeGreaterThanOrEqual(22);
    expect(state().count).toBeLessThanOrEqual(1.5 * FILM.picturesPerS + 2);
    for (const { atMs } of film.all()) expect(film.at(atMs)?.atMs).toBe(atMs);
    for (const atMs of [600, 1000, 1400, 1900]) {
      expect(Math.abs((film.at(atMs)?.atMs ?? NaN) - atMs)).toBeLessThan(1000 / FILM.picturesPerS + STEP_MS);
      expect(await at(atMs)).toBeGreaterThan(await at(atMs - 90));
    }
    expect(film.at(300)).toBeNull();
  });

  test('is taken while the switch is on only, and each motion replaces it', async () => {
    const { film, playback, playhead, run, state } = await filmed();
    playback.play();
    await run(LEAD_MS + 2500);
    expect(state().count).toBe(0);
    film.set(true);
    playback.togglePreview();
    await run(2500);
    expect(state().count).toBe(0);
    playback.play();
    await run(LEAD_MS + 2500);
    expect(state().fromMs).toBeLessThan(600);
    playhead.go(1500);
    playback.play();
    await run(LEAD_MS + 2500);
    expect(state().fromMs).toBeGreaterThanOrEqual(1500);
    film.clear();
    expect(state()).toMatchObject({ count: 0, mebibytes: 0, isShown: false, isOn: true });
    expect(film.all()).toEqual([]);
  });

  test('of several passes each moment has the newest picture', async () => {
    const { film, playback, run, at, state } = await filmed();
    film.set(true);
    playback.set({ loops: true });
    playback.play();
    await run(LEAD_MS + 1500);
    const first = await at(1000);
    await run(4000);
    expect(state().isFilming).toBe(true);
    playback.pause();
    await run(200);
    expect(await at(1000)).toBeGreaterThan(first);
    expect(state().count).toBeLessThanOrEqual(2 * FILM.picturesPerS + 1);
  });

  test('a camera that has died leaves a gap, not its last picture', async () => {
    const { film, playback, run, draw } = await filmed({ lengthMs: 8000 });
    film.set(true);
    playback.play();
    await run(LEAD_MS + 1000);
    await draw(8000);
    expect(film.at(1400)).not.toBeNull();
    expect(film.at(3000)).not.toBeNull();
    expect(film.at(4000)).toBeNull();
  });

  test.for([
    ['a minute', { lengthMs: 70_500, bytes: 10, everyMs: 40 }, FILM.longestS * FILM.picturesPerS],
    ['its bytes', { lengthMs: 3500, bytes: 4 * 1024 * 1024, everyMs: 60 }, 12],
  ] as const)('is bounded by %s, and says so', async ([, camera, most]) => {
    const { film, playback, run, state } = await filmed(camera);
    film.set(true);
    playback.play();
    await run(LEAD_MS + camera.lengthMs);
    expect(state()).toMatchObject({ count: most, isFull: true });
    expect(state().mebibytes).toBeLessThanOrEqual(FILM.mostMebibytes);
    expect(film.all()).toHaveLength(most);
  });

  test('belongs to the open group: another one begins without it', async () => {
    const { film, playback, run, state, opened } = await filmed();
    film.set(true);
    playback.play();
    await run(LEAD_MS + 2500);
    expect(state().count).toBeGreaterThan(0);
    opened.setState({ openId: 'other' });
    expect(state()).toMatchObject({ count: 0, isShown: false });
  });

  test('a picture that is encoded while the film is deleted does not come back', async () => {
    const { playback, playhead, opened, draw } = await filmed();
    let encoded: (jpeg: Blob) => void = () => undefined;
    const film = createFilm(
      { playback, playhead, library: { store: opened } },
      () => new Promise((resolve) => (encoded = resolve)),
    );
    film.set(true);
    playback.play();
    await draw(LEAD_MS + 200);
    const taken = film.take(CANVAS, SIZE);
    film.clear();
    encoded(new Blob(['late']));
    await taken;
    expect(film.all()).toEqual([]);
  });
});
