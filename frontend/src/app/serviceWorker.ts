// The service worker of the static site: keeps every file of the page, so that it opens without a network. A new version waits until
// a page requests it, which only a person can start there. Knows nothing of robots.

import { cleanupOutdatedCaches, precacheAndRoute, type PrecacheEntry } from 'workbox-precaching';

interface UpdateMessage extends MessageEvent<{ type?: string } | null> {
  waitUntil(work: Promise<unknown>): void;
}

/** What this module needs of a service worker's global scope; the compiler's library for it contradicts the one for pages. */
interface ServiceWorker {
  /** The list of the build, set by scripts/build_site.mjs. */
  readonly SITE_FILES: PrecacheEntry[];
  readonly clients: { matchAll(options: { includeUncontrolled: boolean }): Promise<readonly unknown[]> };
  skipWaiting(): Promise<void>;
  addEventListener(type: 'message', listener: (event: UpdateMessage) => void): void;
}

declare const self: ServiceWorker;

precacheAndRoute(self.SITE_FILES);
cleanupOutdatedCaches();

/** How often the open pages are counted again, and how long after each other: a page that was just closed is listed a moment longer. */
const COUNTS = 5;
const COUNT_EVERY_MS = 200;

async function isOnlyPage(): Promise<boolean> {
  for (let count = 0; count < COUNTS; count++) {
    if (count > 0) await new Promise((resolve) => setTimeout(resolve, COUNT_EVERY_MS));
    if ((await self.clients.matchAll({ includeUncontrolled: true })).length <= 1) return true;
  }
  return false;
}

/** Other open pages would miss the files that they have not loaded yet, so they are closed first. */
self.addEventListener('message', (event) => {
  if (event.data?.type !== 'update') return;
  const answered = isOnlyPage().then((isOnly) => {
    event.ports[0]?.postMessage(isOnly);
    if (isOnly) void self.skipWaiting();
  });
  event.waitUntil(answered);
});
