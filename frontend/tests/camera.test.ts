// The picture of a camera beside the sliders: one of the gateway's, and the way to it where there is none.

import * as group from '../../e2e/fixtures/group.ts';
import { expect, here, poll, test } from './harness/test.ts';
import { advance, realMoment } from './harness/time.ts';

const captureGroup = here(group.captureGroup);

const withoutGateway = window.fetch;

test.afterEach(() => {
  window.fetch = withoutGateway;
});

/** A picture of that size as a part of motion JPEG. */
async function partOf(width: number, height: number): Promise<Uint8Array> {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d')?.fillRect(0, 0, 1, 1);
  const picture = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer());
  const head = `--frame\r\nContent-Type: image/jpeg\r\nContent-Length: ${picture.length}\r\n\r\n`;
  return new Uint8Array([...new TextEncoder().encode(head), ...picture, 13, 10]);
}

interface Source {
  send(part: Uint8Array): void;
  end(): void;
  /** The page reads it no further. */
  isLeft(): boolean;
}

/** The gateway's cameras; each stream that is opened goes to `opened`. */
function serveCameras(names: readonly string[], opened: (path: string, source: Source) => void): void {
  const headers = { 'content-type': 'multipart/x-mixed-replace; boundary=frame' };
  window.fetch = (input, init) => {
    const { pathname } = new URL(input instanceof Request ? input.url : input, location.href);
    if (pathname === '/api/cameras')
      return Promise.resolve(Response.json(names.map((name, id) => ({ id, name }))));
    if (!pathname.startsWith('/api/cameras/')) return withoutGateway(input, init);
    const body = new ReadableStream<Uint8Array>({
      start: (stream) => {
        opened(pathname, {
          send: (part) => stream.enqueue(part),
          end: () => stream.close(),
          isLeft: () => init?.signal?.aborted === true,
        });
      },
    });
    return Promise.resolve(new Response(body, { headers }));
  };
}

test.describe('in Drive', () => {
  test.override({ workspace: 'live' });

  test('the picture of a camera at the gateway comes, its end is said, and it is tried again', async ({
    dashboard,
    page,
  }) => {
    const streams: [string, Source][] = [];
    serveCameras(['Bench', 'Door'], (...stream) => streams.push(stream));
    await page.getByRole('radio', { name: 'Camera' }).check();
    const picture = page.getByRole('img', { name: 'Picture of the camera Bench' });
    const size = () =>
      picture.evaluate((element) => {
        const { width, height } = element as unknown as HTMLCanvasElement;
        return [width, height];
      });
    await expect(page.getByText('Waiting for the first picture')).toBeVisible();
    const opened = () => Promise.resolve(streams.length);
    await poll(opened).toBe(1);
    streams[0]?.[1].send(await partOf(64, 48));
    await expect(page.getByText(/^Newest picture [\d,]+\sms ago$/)).toBeVisible();
    expect(await size()).toEqual([64, 48]);
    await expect(dashboard.slider(1)).toBeEnabled();

    streams[0]?.[1].end();
    await expect(page.getByText('The camera’s stream has ended.')).toBeVisible();
    await dashboard.button('Try again').click();
    await poll(opened).toBe(2);
    streams[1]?.[1].send(await partOf(32, 24));
    await expect(page.getByText(/^Newest picture/)).toBeVisible();
    expect(await size()).toEqual([32, 24]);

    await page.getByRole('combobox', { name: 'Camera' }).selectOption('Door');
    await expect(page.getByRole('img', { name: 'Picture of the camera Door' })).toBeVisible();
    await poll(opened).toBe(3);
    streams[2]?.[1].send(new TextEncoder().encode(`--frame\r\n${'x'.repeat(5000)}`));
    await expect(page.getByText('The camera’s stream cannot be read.')).toBeVisible();
    expect(streams[2]?.[1].isLeft()).toBe(true);
    expect(streams.map(([path]) => path)).toEqual([0, 0, 1].map((id) => `/api/cameras/${id}/stream`));
  });

  test('a gateway that refuses says why, and is not taken for one without cameras', async ({
    dashboard,
    page,
  }) => {
    window.fetch = (input, init) =>
      new URL(input instanceof Request ? input.url : input, location.href).pathname === '/api/cameras'
        ? Promise.resolve(Response.json({ code: 'tooMany', detail: 'Try again in 1 s.' }, { status: 429 }))
        : withoutGateway(input, init);
    await page.getByRole('radio', { name: 'Camera' }).check();
    await expect(page.getByText('Try again in 1 s.')).toBeVisible();
    await expect(page.getByText('No camera yet')).toHaveCount(0);
    serveCameras([], () => undefined);
    await dashboard.button('Try again').click();
    await expect(page.getByText('No camera yet')).toBeVisible();
  });

  test('without a camera the page says how the gateway gets one', async ({ dashboard, page }) => {
    serveCameras([], () => undefined);
    await page.getByRole('radio', { name: 'Camera' }).check();
    await expect(page.getByText('No camera yet')).toBeVisible();
    await expect(page.getByText(/^servodeck serve --camera /)).toBeVisible();
    await expect(dashboard.button('Copy command')).toBeEnabled();
    await expect(dashboard.button('Use this computer’s camera')).toBeEnabled();
  });
});

test.describe('beside the timeline', () => {
  test('a motion is filmed, and its pictures step with the playhead, from the film and from the timeline', async ({
    dashboard,
    page,
  }) => {
    const streams: Source[] = [];
    serveCameras(['Bench'], (_, source) => streams.push(source));
    await captureGroup(dashboard, [1000, 1400, 1000], 400);
    await page.getByRole('radio', { name: 'Camera' }).check();
    await poll(() => Promise.resolve(streams.length)).toBe(1);
    await page.getByRole('switch', { name: 'Film' }).check();
    await expect(page.getByText(/^Films the motions that play, up to 60 s and 48 MB/)).toBeVisible();
    // Each picture is wider than the one before. All at once: a busy browser encodes when it is idle.
    const pictures = await Promise.all(Array.from({ length: 40 }, (_, at) => partOf(20 + 2 * at, 48)));
    await dashboard.button('Play').click();
    for (const [at, picture] of pictures.entries()) {
      if (at >= 10 && (await dashboard.button('Play').count()) > 0) break;
      streams[0]?.send(picture);
      await realMoment();
      await advance(96);
    }
    const film = page.getByRole('img', { name: /^Film at/ });
    const widthOf = () => film.evaluate((canvas) => (canvas as unknown as HTMLCanvasElement).width);
    const place = page.getByRole('slider', { name: 'Place in the film' });
    await expect(film).toBeVisible();
    await place.press('End');
    // Drawn once it is decoded.
    await poll(widthOf).toBeGreaterThan(24);
    const last = await widthOf();
    await place.press('Home');
    await poll(widthOf).toBeLessThan(last);
    const first = await widthOf();
    await place.press('ArrowRight');
    await place.press('ArrowRight');
    await poll(widthOf).toBeGreaterThan(first);
    await dashboard.button('Frame forward').click();
    await expect(place).toHaveAttribute('aria-valuetext', '0.8 sec');
    // The picture of a moment was taken within its fifteenth of a second: from 0.80 to 0.87 s, or in the moment before.
    await expect(film).toHaveAccessibleName(/^Film at 0\.[789] sec$/);
    await page.getByRole('radio', { name: 'Live' }).check();
    await expect(film).toHaveCount(0);
    await page.getByRole('button', { name: 'Delete film' }).click();
    await expect(place).toHaveCount(0);
  });
});

test.describe('on a phone', () => {
  test.override({ workspace: 'live', viewport: { width: 390, height: 844 } });

  test('the camera stands above the sliders in place of the drawing, and above the frames, too', async ({
    dashboard,
    page,
  }) => {
    const streams: Source[] = [];
    serveCameras(['Bench'], (_, source) => streams.push(source));
    await dashboard.button('Camera').click();
    await expect(page.getByRole('img', { name: 'Picture of the camera Bench' })).toBeVisible();
    await dashboard.type(dashboard.target(1), 1500);
    await expect(dashboard.estimate(1)).toHaveText('≈ 1500');
    await page.getByRole('tab', { name: 'Animate' }).click();
    await poll(() => Promise.resolve(streams.length)).toBe(2);
    streams[1]?.send(await partOf(64, 48));
    await expect(page.getByText(/^Newest picture/)).toBeVisible();
    expect(streams[0]?.isLeft()).toBe(true);
    await dashboard.button('Camera').click();
    await expect(page.getByRole('img', { name: 'Picture of the camera Bench' })).toBeHidden();
  });
});
