// The service worker of the static site: keeps every file of the page, so that it opens without a network. A new version waits until
// a page asks for it, and a page asks only when a person does. Knows nothing of robots.

import { cleanupOutdatedCaches, precacheAndRoute, type PrecacheEntry } from 'workbox-precaching';

/** What this module needs of a service worker's global scope; the compiler's library for it contradicts the one for pages. */
interface ServiceWorker {
  /** The list of the build, set by scripts/build_site.mjs. */
  readonly SITE_FILES: PrecacheEntry[];
  readonly clients: { matchAll(options: { includeUncontrolled: boolean }): Promise<readonly unknown[]> };
  skipWaiting(): Promise<void>;
  addEventListener(type: 'message', listener: (event: MessageEvent<{ type?: string } | null>) => void): void;
}

declare const self: ServiceWorker;

precacheAndRoute(self.SITE_FILES);
cleanupOutdatedCaches();

/** Other open pages would miss the files that they have not loaded yet, so they are closed first. */
self.addEventListener('message', ({ data, ports: [answer] }) => {
  if (data?.type !== 'update') return;
  void self.clients.matchAll({ includeUncontrolled: true }).then((pages) => {
    const isOnly = pages.length <= 1;
    answer?.postMessage(isOnly);
    if (isOnly) void self.skipWaiting();
  });
});
