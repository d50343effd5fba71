// The run that goes on, or may, without whoever began it: said to everybody, also where nobody else is there.

import { useState } from 'react';
import { useSnapshot, useStores } from '../stores.ts';
import type { Unattended } from '#shared/robot/lease.ts';
import { Button } from '../../ui/Button.tsx';
import { Mark } from '../../ui/Chip.tsx';
import { cx } from '../../ui/cx.ts';
import { useNow } from '../../ui/useNow.ts';
import { personWithin } from '../../i18n/sentences/people.ts';
import { words } from '../../i18n/words.ts';
import styles from './LeaseChip.module.css';

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
            {isOurs ? mayGoOn(run) : goesOn(run, you)}
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

function mayGoOn({ slot }: Unattended): string {
  return slot === null ? words.lease.playingMayGoOn : words.lease.mayGoOn({ slot });
}

function goesOn({ slot, by }: Unattended, you: string): string {
  const name = personWithin(by, you);
  return slot === null ? words.lease.playingGoesOn({ name }) : words.lease.goesOn({ slot, name });
}

/** Counts from when it was told. */
function Left({ run: { endsInMs } }: { readonly run: Unattended }) {
  const { device } = useStores();
  const [toldMs] = useState(device.clock.now);
  const nowMs = useNow(device.clock.now, 250);
  return words.lease.goesOnFor({ ms: endsInMs - (nowMs - toldMs) });
}
