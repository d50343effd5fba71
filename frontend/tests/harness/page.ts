// The page in this window: opened, reloaded and left as a browser does it, without a gateway. Knows how the entry puts it
// together, and no panel.

import { createElement, StrictMode, type ReactNode } from 'react';
import { createRoot, type Root } from 'react-dom/client';
import { commands, page as tester } from 'vitest/browser';
import { App } from '../../src/app/App.tsx';
import { arrive } from '../../src/app/arrival.ts';
import { openPage } from '../../src/app/page.ts';
import { Gallery } from '../../src/app/gallery/Gallery.tsx';
import { fetchRest } from '../../src/ui/later.tsx';
import { preferredLanguage, speak } from '../../src/i18n/words.ts';
import type { Media, Screen } from './commands.ts';
import { watchFiles } from './files.ts';
import { act, keyboard, mouse, touchscreen } from './input.ts';
import { handleOf, Locator } from './locator.ts';
import { advance, during, endTimers, eventually, FRAME_MS, realFrame, standStillFor, turn } from './time.ts';
import '../../src/ui/fonts.css';
import '../../src/ui/tokens.css';
import '../../src/ui/base.css';

// What the first load leaves out has come: how long that takes is for a server to say, not for a panel.
await fetchRest(() => Promise.resolve());

const HOME = '/';
const OPENING_MS = 3 * FRAME_MS;

/** Where files come from in these tests. */
export const ADDRESS = location.origin;

let root: Root | null = null;
let shown = HOME;
/** Of the page's own code, on what outlives it here. */
let listening: (() => void)[] = [];
let workers: Worker[] = [];

/** Files only: no gateway answers. */
const fetchFiles = window.fetch.bind(window);
window.fetch = (input, init) => {
  const { pathname } = new URL(input instanceof Request ? input.url : input, location.href);
  return pathname.startsWith('/api/')
    ? Promise.resolve(new Response('no such file', { status: 404 }))
    : fetchFiles(input, init);
};

window.Worker = class extends Worker {
  constructor(...options: ConstructorParameters<typeof Worker>) {
    super(...options);
    workers.push(this);
  }
};

/** What the page has begun in its database. One that is left still writes, into what the next one is to find empty. */
const storing = new Set<EventTarget>();

function noteStoring<T extends EventTarget>(work: T, ...ends: readonly string[]): T {
  storing.add(work);
  for (const end of ends) work.addEventListener(end, () => storing.delete(work));
  return work;
}

const { open } = IDBFactory.prototype;
IDBFactory.prototype.open = function (...options) {
  return noteStoring(open.apply(this, options), 'success', 'error');
};
const { transaction } = IDBDatabase.prototype;
IDBDatabase.prototype.transaction = function (...options) {
  return noteStoring(transaction.apply(this, options), 'complete', 'abort');
};

/** Pictures are decoded and encoded beside the page, in real time. */
const { createImageBitmap: decode } = window;
window.createImageBitmap = (...options: unknown[]) => {
  const decoded = Reflect.apply(decode, window, options) as Promise<ImageBitmap>;
  standStillFor(decoded);
  return decoded;
};
const { convertToBlob } = OffscreenCanvas.prototype;
OffscreenCanvas.prototype.convertToBlob = function (...options) {
  const encoded = convertToBlob.apply(this, options);
  standStillFor(encoded);
  return encoded;
};

/** A lock is granted in another process: a free one has been, once that process has answered what was asked later. */
const { request } = LockManager.prototype;
LockManager.prototype.request = function (...options: unknown[]) {
  const granted = Reflect.apply(request, this, options) as Promise<unknown>;
  standStillFor(this.query());
  return granted;
};

/** What is listened to while a page is being put together ends with it; a browser sees to that at a reload. */
async function noteListeners<T>(open: () => Promise<T>): Promise<T> {
  const places: readonly EventTarget[] = [window, document];
  const add = EventTarget.prototype.addEventListener;
  for (const place of places)
    place.addEventListener = (...options: Parameters<typeof add>) => {
      add.apply(place, options);
      listening.push(() => place.removeEventListener(options[0], options[1], options[2]));
    };
  try {
    return await open();
  } finally {
    for (const place of places) Reflect.deleteProperty(place, 'addEventListener');
  }
}

async function show(address: string): Promise<void> {
  const { pathname, search } = new URL(address, location.href);
  shown = address;
  const element = document.createElement('div');
  element.id = 'page';
  document.body.append(element);
  window.focus();
  // Fetching takes real time; how a page looks meanwhile is for end-to-end tests.
  await fetchRest(() => Promise.resolve());
  let content: ReactNode;
  if (pathname.endsWith('gallery.html')) {
    history.replaceState(null, '', search);
    await speak(preferredLanguage([new URLSearchParams(search).get('language') ?? 'en']));
    content = createElement(Gallery);
  } else {
    const page = await noteListeners(async () => openPage(await arrive(window)));
    content = createElement(StrictMode, null, createElement(App, { page }));
  }
  root = createRoot(element);
  root.render(content);
  await advance(OPENING_MS);
}

const tested = location.search;

/** As a browser leaves a page: it hears of it, and then nothing of it is left but what it stored. */
async function leave(): Promise<void> {
  if (root === null) return;
  window.dispatchEvent(new PageTransitionEvent('pagehide'));
  root.unmount();
  root = null;
  // A browser takes them back at once.
  await eventually(async () => {
    const { held = [] } = await navigator.locks.query();
    if (held.length > 0) throw new Error('the page holds on to its port');
  });
  for (const forget of listening) forget();
  for (const worker of workers) worker.terminate();
  [listening, workers] = [[], []];
  endTimers();
  await eventually(async () => {
    await turn();
    if (storing.size > 0) throw new Error('the page still writes into its database');
  });
  document.body.replaceChildren();
  document.title = '';
  for (const name of Object.keys(document.documentElement.dataset))
    Reflect.deleteProperty(document.documentElement.dataset, name);
  history.replaceState(null, '', tested);
}

async function forgetAll(): Promise<void> {
  // What the last test plugged in.
  for (const name of ['getGamepads', 'serial']) Reflect.deleteProperty(navigator, name);
  localStorage.clear();
  sessionStorage.clear();
  for (const { name = '' } of await indexedDB.databases())
    await new Promise<void>((resolve, reject) => {
      const asked = indexedDB.deleteDatabase(name);
      asked.addEventListener('success', () => resolve());
      asked.addEventListener('error', () => reject(new Error(`the browser keeps ${name}`)));
    });
}

export interface Look extends Media {
  readonly viewport: { readonly width: number; readonly height: number };
  readonly screen: Screen;
}

const same = (one: unknown, other: unknown): boolean => JSON.stringify(one) === JSON.stringify(other);
const USUAL_MEDIA: Media = {
  ...{ media: null, colorScheme: 'light', reducedMotion: 'reduce', forcedColors: 'none' },
  contrast: 'no-preference',
};
let media: Media = USUAL_MEDIA;
let screen: Screen = { hasTouch: false, deviceScaleFactor: 1 };

export function createPage() {
  const files = watchFiles();
  const everything = new Locator('');
  const scripts: (() => void)[] = [];

  async function emulateMedia(wanted: Media): Promise<void> {
    const next = { ...media, ...wanted };
    if (same(next, media)) return;
    media = next;
    await commands.emulateMedia(media);
    await realFrame();
  }

  async function setViewportSize(size: { readonly width: number; readonly height: number }): Promise<void> {
    if (size.width === innerWidth && size.height === innerHeight) return;
    await tester.viewport(size.width, size.height);
    await realFrame();
    await advance(OPENING_MS);
  }

  async function goto(address: string): Promise<void> {
    await leave();
    for (const run of scripts) run();
    await show(address);
  }

  return {
    ...{ goto, emulateMedia, setViewportSize, mouse, keyboard, touchscreen },
    getByRole: everything.getByRole,
    getByText: everything.getByText,
    getByLabel: everything.getByLabel,
    locator: everything.locator,
    reload: () => goto(shown),
    /** What is opened next is opened by a browser that was never here. */
    async forget(): Promise<void> {
      await leave();
      await forgetAll();
    },
    viewportSize: () => ({ width: innerWidth, height: innerHeight }),
    evaluate: async <T, A>(run: (argument: A) => T, argument?: A): Promise<Awaited<T>> => {
      const result = await during(Promise.resolve(run(argument as A)));
      await advance(FRAME_MS);
      return result;
    },
    evaluateHandle: async <T, A>(run: (argument: A) => T, argument?: A) => handleOf(await run(argument as A)),
    /** Runs at each opening, before the page. */
    addInitScript<A>(run: (argument: A) => void, argument?: A): Promise<void> {
      scripts.push(() => run(argument as A));
      return Promise.resolve();
    },
    waitForFunction: <A>(holds: (argument: A) => unknown, argument?: A) =>
      eventually(async () => {
        if (!(await holds(argument as A))) throw new Error('it does not hold');
      }),
    waitForEvent: files.next,
    title: () => Promise.resolve(document.title.replaceAll(/\s+/g, ' ')),

    async begin({ viewport: size, screen: wanted, ...looks }: Look): Promise<void> {
      await emulateMedia({ ...USUAL_MEDIA, ...looks });
      if (!same(wanted, screen)) await commands.emulateScreen((screen = wanted));
      await setViewportSize(size);
      await forgetAll();
    },
    async end(): Promise<void> {
      await leave();
      // Also of a test that opened none.
      document.body.replaceChildren();
      files.end();
      await act(['move', 0, 0], ['leaveClipboard']);
    },
  };
}

export type Page = ReturnType<typeof createPage>;
