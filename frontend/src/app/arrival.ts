// How a person arrives at the page (with a link that pairs, with one that only stops, or with neither) and how the page reports that it is
// hidden or left. Secrets in the address leave it at once, so that neither history nor a screenshot stores them.

import type { StoreApi } from 'zustand/vanilla';
import type { DeviceState } from '../robot/device.ts';
import { PeopleError, pair, readMe } from '../features/people/people.ts';
import type { Me, PairWish, You } from '#shared/client/http.generated.ts';

export interface Arrival {
  /** null: no gateway serves this page. */
  readonly me: Me | null;
  /** Whom the link in the address has let in just now: no name has been requested yet. */
  readonly entered: You | null;
  /** Why the link in the address did not let in, or why a page that was in is out. */
  readonly problem: PeopleError | null;
}

type Paired = Omit<Arrival, 'me'>;

const LINKS = { pair: 'secret', stop: 'stop' } as const;

/** What the address says, as a wish to the gateway; null for an ordinary one. */
export function wishIn(hash: string): PairWish | null {
  const [name, secret = ''] = hash.replace(/^#/, '').split('=', 2);
  if ((name !== 'pair' && name !== 'stop') || secret === '') return null;
  return { [LINKS[name]]: secret };
}

export async function arrive(page: Window): Promise<Arrival> {
  const wish = wishIn(page.location.hash);
  if (wish !== null) page.history.replaceState(null, '', page.location.pathname + page.location.search);
  page.addEventListener('hashchange', () => {
    if (wishIn(page.location.hash) !== null) page.location.reload();
  });
  const { entered, problem } = wish === null ? { entered: null, problem: null } : await tryToPair(wish);
  const me = await readMe();
  return { me, entered, problem: problem ?? sentAway(page.history, me) };
}

const PAIRED = 'paired';

/** A page that was revoked begins anew, and its history is what it keeps of itself. */
export function sentAway(
  history: Pick<History, 'state' | 'replaceState'>,
  me: Me | null,
): PeopleError | null {
  if (me === null || me.mode === 'local') return null;
  if (me.you === null) return history.state === PAIRED ? new PeopleError('notPaired', '') : null;
  history.replaceState(PAIRED, '');
  return null;
}

async function tryToPair(wish: PairWish): Promise<Paired> {
  try {
    const you = await pair({ ...wish, name: deviceName(navigator.userAgent) });
    return { entered: you.role === 'stopper' ? null : you, problem: null };
  } catch (error) {
    if (error instanceof PeopleError) return { entered: null, problem: error };
    throw error;
  }
}

/** What a device calls itself until a person says a name; names of makers, the same in every language. */
const DEVICES: readonly (readonly [RegExp, string])[] = [
  [/iphone/i, 'iPhone'],
  [/ipad/i, 'iPad'],
  [/android/i, 'Android'],
  [/cros/i, 'Chromebook'],
  [/windows/i, 'Windows'],
  [/mac/i, 'Mac'],
];

export function deviceName(userAgent: string): string {
  return DEVICES.find(([sign]) => sign.test(userAgent))?.[1] ?? 'Linux';
}

/** Whether the person `before` is another one now: revoked, or with another role. */
export function isAnother(before: You | null, now: Me | null): boolean {
  if (now === null || before === null) return false;
  return now.you?.id !== before.id || now.you.role !== before.role;
}

/**
 * A lost gateway may have sent this device away, made more or less of it, or come back as one that lets in paired devices only:
 * queried at each attempt, because at the first it may not be back yet.
 */
export function beginAnewAsAnother(
  store: Pick<StoreApi<Pick<DeviceState, 'snapshot'>>, 'subscribe'>,
  you: You,
  begin: () => void,
  read: () => Promise<Me | null> = readMe,
): void {
  store.subscribe(({ snapshot: { link } }, before) => {
    if (link.status !== 'lost' || link === before.snapshot.link) return;
    void read().then((now) => {
      if (isAnother(you, now)) begin();
    });
  });
}

interface Leaving {
  /** Timers get slow now, and the page is not visible. */
  hidden(): void;
  /** Closed, reloaded, frozen, or stored for the way back. */
  left(): void;
}

export function watchLeaving(page: Pick<Window, 'addEventListener' | 'document'>, leaving: Leaving): void {
  const { document } = page;
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') leaving.hidden();
  });
  document.addEventListener('freeze', leaving.left);
  page.addEventListener('pagehide', leaving.left);
}
