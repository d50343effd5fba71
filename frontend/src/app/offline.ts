// Makes the static site work without a network, and offers its new versions: never by itself, and never while the robot moves.

import { messageSW, Workbox } from 'workbox-window';
import { words } from '../i18n/whole.ts';
import type { Device } from '../robot/device.ts';
import type { Notices } from '../state/notices.ts';

const LOOK_AGAIN_MS = 60 * 60_000;

interface OfflineOptions {
  readonly notices: Notices;
  readonly device: Pick<Device, 'clock' | 'isAtRest'>;
}

/** Where the browser has no service workers, or refuses one, the page works as long as the network does. */
export async function workOffline({ notices, device }: OfflineOptions): Promise<void> {
  if (!('serviceWorker' in navigator)) return;
  const workbox = new Workbox(new URL('sw.js', document.baseURI).href);
  let isWanted = false;

  workbox.addEventListener('waiting', ({ sw: newVersion }) => {
    if (newVersion === undefined) return;
    const offer = (text: string): void =>
      notices.show('warning', text, {
        label: words.site.update,
        act: () => {
          if (device.isAtRest()) void update();
          else offer(words.site.updateMoving);
        },
      });
    const update = async (): Promise<void> => {
      isWanted = true;
      const isOnlyPage: unknown = await messageSW(newVersion, { type: 'update' });
      if (isOnlyPage === true) return;
      isWanted = false;
      offer(words.site.updateOthers);
    };
    offer(words.site.newVersion);
  });
  workbox.addEventListener('controlling', () => {
    if (isWanted) location.reload();
  });
  const look = (): void => {
    void workbox.update().catch(() => undefined);
    device.clock.after(LOOK_AGAIN_MS, look);
  };
  await workbox.register().then(
    () => device.clock.after(LOOK_AGAIN_MS, look),
    () => undefined,
  );
}
