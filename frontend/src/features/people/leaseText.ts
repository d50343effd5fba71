// The texts and actions about the lease, from the view of this page's person.

import type { Lease, LeaseAction } from '#shared/robot/lease.ts';
import { personName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Device } from '../../robot/device.ts';
import type { Notices } from '../../state/notices.ts';
import type { Truth } from '../../ui/Chip.tsx';

/** Shows a notice when another person hands the robot to this page without a request. */
export function tellHandedOver(
  store: Pick<Device['store'], 'subscribe'>,
  notices: Pick<Notices, 'tell'>,
): void {
  store.subscribe(({ snapshot: { lease } }, { snapshot: before }) => {
    const giver = lease?.grantedBy ?? null;
    if (lease !== null && giver !== null && giver !== before.lease?.grantedBy)
      notices.tell('info', words.lease.given({ name: personName(giver, lease.you) }));
  });
}

export interface LeaseOffer {
  readonly label: string;
  readonly hint?: string;
  readonly tone: 'plain' | 'quiet';
  readonly wish: LeaseAction;
}

export interface LeaseText {
  readonly truth: Truth;
  readonly text: string;
  /** `countdown`: how long the driver may still refuse. */
  readonly more: { readonly said: string } | 'countdown';
  readonly acts: readonly LeaseOffer[];
}

export function leaseTextOf(lease: Lease): LeaseText {
  if (lease.drives)
    return lease.requestedBy === null ? driving(lease) : beingRequested(lease, lease.requestedBy);
  return lease.driver === null ? unclaimed(lease) : watching(lease, lease.driver);
}

const driving = ({ you, grantedBy, others }: Lease): LeaseText => ({
  truth: 'confirmed',
  text: words.lease.drives,
  more: {
    said:
      grantedBy === null
        ? words.lease.others({ count: others })
        : words.lease.given({ name: personName(grantedBy, you) }),
  },
  acts: [{ label: words.lease.release, hint: words.lease.releaseHint, tone: 'quiet', wish: 'release' }],
});

const beingRequested = ({ you }: Lease, requestedBy: string): LeaseText => ({
  truth: 'warning',
  text: words.lease.asker({ name: personName(requestedBy, you) }),
  more: 'countdown',
  acts: [
    { label: words.lease.allow, tone: 'plain', wish: 'release' },
    { label: words.lease.refuse, tone: 'plain', wish: 'refuse' },
  ],
});

const unclaimed = ({ mayDrive }: Lease): LeaseText => ({
  truth: 'neutral',
  text: words.lease.noDriver,
  more: { said: mayDrive ? words.lease.noDriverMore : words.lease.watching },
  acts: [],
});

function watching({ you, hasRequested, mayDrive, mayTake }: Lease, driver: string): LeaseText {
  const request: LeaseOffer = hasRequested
    ? { label: words.lease.takeBack, tone: 'quiet', wish: 'release' }
    : { label: words.lease.request, hint: words.lease.requestHint, tone: 'plain', wish: 'request' };
  const take = { label: words.lease.take, hint: words.lease.takeHint, tone: 'quiet', wish: 'take' } as const;
  return {
    truth: hasRequested ? 'commanded' : 'neutral',
    text: (hasRequested ? words.lease.asked : words.lease.driver)({ name: personName(driver, you) }),
    more: hasRequested ? 'countdown' : { said: words.lease.watching },
    acts: [...(hasRequested || mayDrive ? [request] : []), ...(mayTake ? [take] : [])],
  };
}
