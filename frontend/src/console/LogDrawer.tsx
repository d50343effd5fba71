// The log at the foot of the page: folded it is one line with the latest packet, unfolded the whole log.

import { useState } from 'react';
import { useStores, useView } from '../stores/stores.ts';
import { Button as AriaButton } from 'react-aria-components/Button';
import { Icon } from '../ui/Icon.tsx';
import { useFollow } from '../ui/useFollow.ts';
import { words } from '../words/words.ts';
import { arrowOf, bytesText, meaning } from './describe.ts';
import { LogPanel } from './LogPanel.tsx';
import { PART } from '../ui/useParts.ts';
import styles from './LogDrawer.module.css';

/** A packet takes longer to read than a number. */
const PACKET_READABLE_MS = 500;

export function LogDrawer() {
  const { view } = useStores();
  const isOpen = useView((state) => state.logOpen);
  if (isOpen) {
    return (
      <div className={styles.open}>
        <LogPanel onFold={() => view.setState({ logOpen: false })} />
      </div>
    );
  }
  return (
    <section {...PART} className={styles.folded} aria-label={words.log.title}>
      <AriaButton
        className={styles.button ?? ''}
        aria-label={words.log.open}
        onPress={() => view.setState({ logOpen: true })}
      >
        <Icon name="up" />
        <span className={styles.title}>{words.log.title}</span>
        <Latest />
      </AriaButton>
    </section>
  );
}

function Latest() {
  const { traffic } = useStores().device;
  const [nextId, show] = useState(traffic.store.getState().nextId);
  useFollow({ read: () => traffic.store.getState().nextId, draw: show, eachMs: PACKET_READABLE_MS });
  // It may have been cleared since.
  const { oldestId } = traffic.store.getState();
  if (nextId <= oldestId) return <span className={styles.latest}>{words.log.empty}</span>;
  const latest = traffic.at(nextId - 1);
  return (
    <>
      <span className={styles.latest}>
        {arrowOf(latest.entry)} {meaning(latest)}
      </span>
      <code className={styles.bytes}>{bytesText(latest)}</code>
    </>
  );
}
