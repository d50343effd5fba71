// Whose turn it is to drive, and the way to the next one's. Whoever is alone on the robot never sees it. A phone has no room for
// several buttons beside what goes on: there the words themselves open what may be done.

import { useState } from 'react';
import { type Unattended, isWatching, type Lease } from '#shared/robot/lease.ts';
import { useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { Mark } from '../../ui/Chip.tsx';
import { cx } from '../../ui/cx.ts';
import { useNow } from '../../ui/useEachFrame.ts';
import { personWithin } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import { Icon } from '../../ui/Icon.tsx';
import { MenuButton } from '../../ui/MenuButton.tsx';
import { useLayout } from '../../ui/useLayout.ts';
import { secondsLeft } from '../../i18n/numbers.ts';
import { turnOf, type Turn, type TurnAct } from './leaseText.ts';
import styles from './LeaseChip.module.css';

// The run that goes on, or may, without whoever began it: said to everybody, also where nobody else is there.

export function UnattendedChip() {
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
      aria-label={words.lease.goesOnLabel}
    >
      <div className={styles.said}>
        <Mark truth="commanded" />
        <div className={styles.words}>
          <p className={styles.text} aria-live="polite">
            {isOurs ? mayKeepRunning(run) : goesOn(run, you)}
          </p>
          <p className={styles.more}>
            <Left key={run.endsInMs} run={run} />
          </p>
        </div>
      </div>
      {isOurs && (
        <Button tone="quiet" hint={words.lease.keepHint} onPress={() => device.letGoOn(null)}>
          {words.lease.keep}
        </Button>
      )}
    </div>
  );
}

function mayKeepRunning({ slot }: Unattended): string {
  return slot === null ? words.lease.playingMayContinue : words.lease.mayKeepRunning({ slot });
}

function goesOn({ slot, by }: Unattended, you: string): string {
  const name = personWithin(by, you);
  return slot === null ? words.lease.playingGoesOn({ name }) : words.lease.goesOn({ slot, name });
}

/** Counts from when it was told. */
function Left({ run: { endsInMs } }: { readonly run: Unattended }) {
  const { device } = useStores();
  const [heardMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  return words.lease.goesOnFor({ ms: endsInMs - (nowMs - heardMs) });
}

export function LeaseChip() {
  const lease = useSnapshot((snapshot) => snapshot.lease);
  const isPhone = useLayout() === 'phone';
  if (lease === null || isAlone(lease)) return null;
  const turn = turnOf(lease);
  const isAsked = lease.drives && lease.requestedBy !== null;
  const isFolded = isPhone && !isAsked && !isOneButton(lease, turn);
  return (
    <div
      className={cx(styles.lease, isAsked && styles.asked)}
      data-turn={isAsked ? 'asked' : 'said'}
      role="group"
      aria-label={words.lease.label}
    >
      {isFolded ? <Folded lease={lease} turn={turn} /> : <Laid lease={lease} turn={turn} />}
    </div>
  );
}

/** No other page is here, and no script drives or asks to. */
function isAlone(lease: Lease): boolean {
  return lease.others === 0 && lease.mayDrive && !isWatching(lease) && lease.requestedBy === null;
}

/** Nothing to do, or the one thing that is worth a button beside the words. */
const isOneButton = ({ candidates }: Lease, { acts }: Turn): boolean =>
  candidates.length === 0 && acts.length <= 1 && acts[0]?.tone !== 'quiet';

interface TurnProps {
  readonly lease: Lease;
  readonly turn: Turn;
}

function Laid({ lease, turn }: TurnProps) {
  const { device } = useStores();
  return (
    <>
      <Said lease={lease} turn={turn} />
      {turn.acts.map(({ label, wish, ...how }) => (
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

function Folded({ lease, turn }: TurnProps) {
  const { device } = useStores();
  const acts = [
    ...turn.acts,
    ...lease.candidates.map(({ id, name }) => ({
      label: words.lease.handOverTo({ name }),
      wish: { grantTo: id },
    })),
  ];
  const choose = (act?: Pick<TurnAct, 'wish'>): void => {
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
        <Said lease={lease} turn={turn} />
        <Icon name="down" />
      </span>
    </MenuButton>
  );
}

function Said({ lease, turn: { truth, text, more } }: TurnProps) {
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

/** Counts from when it was told. */
function PassesIn({ lease: { grantedInMs, hasRequested } }: { readonly lease: Lease }) {
  const { device } = useStores();
  const [heardMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  const leftMs = (grantedInMs ?? 0) - (nowMs - heardMs);
  return (hasRequested ? words.lease.yoursIn : words.lease.theirsIn)({ seconds: secondsLeft(leftMs) });
}
