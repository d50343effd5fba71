// Whose turn it is to drive, and the way to the next one's. Whoever is alone on the robot never sees it.

import { useState } from 'react';
import { useSnapshot, useStores } from '../stores/stores.ts';
import { isWatching, type Lease } from '#shared/session/lease.ts';
import { Button } from '../ui/Button.tsx';
import { Mark, type Truth } from '../ui/Chip.tsx';
import { MenuButton } from '../ui/MenuButton.tsx';
import { useNow } from '../ui/useNow.ts';
import { words } from '../words/words.ts';
import styles from './LeaseChip.module.css';

export function LeaseChip() {
  const lease = useSnapshot((snapshot) => snapshot.lease);
  if (lease === null || isAlone(lease)) return null;
  return (
    <div className={styles.lease} data-turn role="group" aria-label={words.lease.label}>
      {lease.drives ? <Driving lease={lease} /> : <Watching lease={lease} />}
    </div>
  );
}

/** No other page is here, and no script drives or asks to. */
function isAlone(lease: Lease): boolean {
  return lease.others === 0 && lease.mayDrive && !isWatching(lease) && lease.asker === null;
}

function Driving({ lease }: { readonly lease: Lease }) {
  const { device } = useStores();
  if (lease.asker === null) {
    return (
      <>
        <Said truth="confirmed" text={words.lease.drives} more={sinceWhen(lease)} />
        <HandOver lease={lease} />
        <Button tone="quiet" hint={words.lease.releaseHint} onPress={() => device.lease('release')}>
          {words.lease.release}
        </Button>
      </>
    );
  }
  return (
    <>
      <Said truth="warning" text={words.lease.asker(lease.asker)} more={<PassesIn lease={lease} />} />
      <Button onPress={() => device.lease('release')}>{words.lease.allow}</Button>
      <Button onPress={() => device.lease('refuse')}>{words.lease.refuse}</Button>
    </>
  );
}

const sinceWhen = ({ givenBy, others }: Lease): string =>
  givenBy === null ? words.lease.others(others) : words.lease.given(givenBy);

/** Without being asked. */
function HandOver({ lease: { candidates } }: { readonly lease: Lease }) {
  const { device } = useStores();
  if (candidates.length === 0) return null;
  return (
    <MenuButton
      tone="quiet"
      label={words.lease.handOver}
      choices={candidates}
      onChoose={(giveTo) => device.lease({ giveTo })}
    />
  );
}

function Watching({ lease }: { readonly lease: Lease }) {
  const { device } = useStores();
  const { driver, asks, mayDrive, mayTake } = lease;
  if (driver === null) {
    return (
      <>
        <Said
          truth="neutral"
          text={words.lease.nobody}
          more={mayDrive ? words.lease.nobodyMore : words.lease.watching}
        />
        <HandOver lease={lease} />
      </>
    );
  }
  return (
    <>
      {asks ? (
        <Said truth="commanded" text={words.lease.asked(driver)} more={<PassesIn lease={lease} />} />
      ) : (
        <Said truth="neutral" text={words.lease.driver(driver)} more={words.lease.watching} />
      )}
      {mayDrive && !asks && (
        <Button hint={words.lease.requestHint} onPress={() => device.lease('request')}>
          {words.lease.request}
        </Button>
      )}
      {asks && (
        <Button tone="quiet" onPress={() => device.lease('release')}>
          {words.lease.takeBack}
        </Button>
      )}
      {mayTake && (
        <Button tone="quiet" hint={words.lease.takeHint} onPress={() => device.lease('take')}>
          {words.lease.take}
        </Button>
      )}
      <HandOver lease={lease} />
    </>
  );
}

interface SaidProps {
  readonly truth: Truth;
  readonly text: string;
  readonly more: React.ReactNode;
}

function Said({ truth, text, more }: SaidProps) {
  return (
    <div className={styles.said}>
      <Mark truth={truth} />
      <div>
        <p className={styles.text} aria-live="polite">
          {text}
        </p>
        <p className={styles.more}>{more}</p>
      </div>
    </div>
  );
}

/** Counts from when it was told. */
function PassesIn({ lease: { answerInMs, asks } }: { readonly lease: Lease }) {
  const { device } = useStores();
  const [toldMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  const leftMs = (answerInMs ?? 0) - (nowMs - toldMs);
  return asks ? words.lease.yoursIn(leftMs) : words.lease.theirsIn(leftMs);
}
