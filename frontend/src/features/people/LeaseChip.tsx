// Who drives the robot, in words, with the actions to request, grant or release it. Hidden while no other client uses the robot. On a phone the
// text itself opens a menu, because there is no room for several buttons. Loaded with the first robot that can be shared.

import { useEffect, useState, useRef, type ReactNode } from 'react';
import { type Unattended, isWatching, type Lease, type LeaseAction } from '#shared/robot/lease.ts';
import { useSnapshot, useStores } from '../stores.ts';
import { Button, type ButtonProps } from '../../ui/Button.tsx';
import { Mark, type Truth } from '../../ui/Chip.tsx';
import { cx } from '../../ui/cx.ts';
import { useNow } from '../../ui/useEachFrame.ts';
import { personWithin, personName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { Icon } from '../../ui/Icon.tsx';
import { useLayout } from '../../ui/useLayout.ts';
import { secondsLeft } from '../../i18n/numbers.ts';
import styles from './LeaseChip.module.css';
import { later, usePart } from '../../ui/later.tsx';
import type { Device } from '../../robot/device.ts';
import type { Notices } from '../../state/notices.ts';

interface MenuButtonProps extends Pick<ButtonProps, 'tone'> {
  readonly label: string;
  /** Shown in place of the label. */
  readonly children?: ReactNode;
  readonly choices: readonly { readonly id: string; readonly name: string }[];
  onChoose(id: string): void;
}

const menu = later(async () => (await import('../../ui/ChoiceMenu.tsx')).ChoiceMenu);

/** A button with a menu of a few choices. The code of the menu is fetched when one first opens. */
function MenuButton({ label, children = label, choices, onChoose, ...button }: MenuButtonProps) {
  const ref = useRef<HTMLButtonElement>(null);
  const [isOpen, setOpen] = useState(false);
  const { part: ChoiceMenu } = usePart(menu, isOpen);
  return (
    <>
      <Button {...button} ref={ref} aria-haspopup="menu" aria-expanded={isOpen} onPress={() => setOpen(true)}>
        {children}
      </Button>
      {ChoiceMenu !== null && (
        <ChoiceMenu {...{ label, choices, onChoose, isOpen }} under={ref} onClose={() => setOpen(false)} />
      )}
    </>
  );
}

export function LeaseStatus() {
  const { device, notices } = useStores();
  useEffect(() => tellHandedOver(device.store, notices), [device, notices]);
  return (
    <>
      <LeaseChip />
      <UnattendedChip />
    </>
  );
}

/** A run that continues, or may continue, without the person who started it. Shown to every client. */
function UnattendedChip() {
  const { device } = useStores();
  const run = useSnapshot((snapshot) => snapshot.lease?.unattended ?? null);
  const isOurs = useSnapshot((snapshot) => snapshot.lease?.drives ?? false);
  const you = useSnapshot((snapshot) => snapshot.lease?.you ?? '');
  if (run === null) return null;
  return (
    <div
      className={cx(styles.lease, styles.alone)}
      data-alone
      role="group"
      aria-label={words.lease.runsWithoutDriver}
    >
      <div className={styles.said}>
        <Mark truth="commanded" />
        <div className={styles.words}>
          <p className={styles.text} aria-live="polite">
            {isOurs ? mayKeepRunning(run) : keepsRunningText(run, you)}
          </p>
          <p className={styles.more}>
            <Left key={run.endsInMs} run={run} />
          </p>
        </div>
      </div>
      {isOurs && (
        <Button tone="quiet" hint={words.lease.keepHint} onPress={() => device.keepRunning(null)}>
          {words.lease.keep}
        </Button>
      )}
    </div>
  );
}

function mayKeepRunning({ slot }: Unattended): string {
  return slot === null ? words.lease.playingMayContinue : words.lease.mayKeepRunning({ slot });
}

function keepsRunningText({ slot, by, isMove }: Unattended, you: string): string {
  const name = personWithin(by, you);
  if (isMove) return words.lease.moveKeepsGoing({ name });
  return slot === null ? words.lease.playKeepsRunning({ name }) : words.lease.keepsRunning({ slot, name });
}

/** Counts down from the time of the message. */
function Left({ run: { endsInMs } }: { readonly run: Unattended }) {
  const { device } = useStores();
  const [heardMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  return words.lease.keepsRunningFor({ ms: endsInMs - (nowMs - heardMs) });
}

function LeaseChip() {
  const lease = useSnapshot((snapshot) => snapshot.lease);
  const isPhone = useLayout() === 'phone';
  if (lease === null || isAlone(lease)) return null;
  const leaseText = leaseTextOf(lease);
  const isRequested = lease.drives && lease.requestedBy !== null;
  const isFolded = isPhone && !isRequested && !isOneButton(lease, leaseText);
  return (
    <div
      className={cx(styles.lease, isRequested && styles.requested)}
      data-lease={isRequested ? 'requested' : 'said'}
      role="group"
      aria-label={words.lease.label}
    >
      {isFolded ? (
        <LeaseMenu lease={lease} leaseText={leaseText} />
      ) : (
        <LeaseButtons lease={lease} leaseText={leaseText} />
      )}
    </div>
  );
}

/** No other page is connected, and no script drives or requests to. */
function isAlone(lease: Lease): boolean {
  return lease.others === 0 && lease.mayDrive && !isWatching(lease) && lease.requestedBy === null;
}

/** At most one action, shown as a button beside the text. */
const isOneButton = ({ candidates }: Lease, { acts }: LeaseText): boolean =>
  candidates.length === 0 && acts.length <= 1 && acts[0]?.tone !== 'quiet';

interface LeaseProps {
  readonly lease: Lease;
  readonly leaseText: LeaseText;
}

function LeaseButtons({ lease, leaseText }: LeaseProps) {
  const { device } = useStores();
  return (
    <>
      <LeaseWords lease={lease} leaseText={leaseText} />
      {leaseText.acts.map(({ label, wish, ...how }) => (
        <Button key={label} {...how} onPress={() => device.lease(wish)}>
          {label}
        </Button>
      ))}
      {lease.requestedBy === null && lease.candidates.length > 0 && (
        <MenuButton
          tone="quiet"
          label={words.lease.handOver}
          choices={lease.candidates}
          onChoose={(grantTo) => device.lease({ grantTo })}
        />
      )}
    </>
  );
}

function LeaseMenu({ lease, leaseText }: LeaseProps) {
  const { device } = useStores();
  const acts = [
    ...leaseText.acts,
    ...lease.candidates.map(({ id, name }) => ({
      label: words.lease.handOverTo({ name }),
      wish: { grantTo: id },
    })),
  ];
  const choose = (act?: Pick<LeaseOffer, 'wish'>): void => {
    if (act !== undefined) device.lease(act.wish);
  };
  return (
    <MenuButton
      tone="quiet"
      label={words.lease.label}
      choices={acts.map(({ label }, index) => ({ id: String(index), name: label }))}
      onChoose={(index) => choose(acts[Number(index)])}
    >
      <span className={styles.face}>
        <LeaseWords lease={lease} leaseText={leaseText} />
        <Icon name="down" />
      </span>
    </MenuButton>
  );
}

function LeaseWords({ lease, leaseText: { truth, text, more } }: LeaseProps) {
  return (
    <span className={styles.said}>
      <Mark truth={truth} />
      <span className={styles.words} data-words>
        <span className={styles.text} aria-live="polite">
          {text}
        </span>
        <span className={styles.more}>{more === 'countdown' ? <PassesIn lease={lease} /> : more.said}</span>
      </span>
    </span>
  );
}

/** Counts down from the time of the message. */
function PassesIn({ lease: { grantedInMs, hasRequested } }: { readonly lease: Lease }) {
  const { device } = useStores();
  const [heardMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  const leftMs = (grantedInMs ?? 0) - (nowMs - heardMs);
  return (hasRequested ? words.lease.yoursIn : words.lease.theirsIn)({ seconds: secondsLeft(leftMs) });
}

/** Shows a notice when another person hands the robot to this page without a request. Returns a function that ends it. */
export function tellHandedOver(
  store: Pick<Device['store'], 'subscribe'>,
  notices: Pick<Notices, 'show'>,
): () => void {
  return store.subscribe(({ snapshot: { lease } }, { snapshot: before }) => {
    const giver = lease?.grantedBy ?? null;
    if (lease !== null && giver !== null && giver !== before.lease?.grantedBy)
      notices.show('info', words.lease.given({ name: personName(giver, lease.you) }));
  });
}

interface LeaseOffer {
  readonly label: string;
  readonly hint?: string;
  readonly tone: 'plain' | 'quiet';
  readonly wish: LeaseAction;
}

interface LeaseText {
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
