// The log at the foot of the page: folded it is one line with the latest packet or the stop that holds, unfolded the whole log.

import { useMemo } from 'react';
import { useStores, useView } from '../stores/stores.ts';
import { Icon } from '../ui/Icon.tsx';
import { LiveText } from '../ui/LiveText.tsx';
import { pressOnce } from '../ui/pressOnce.ts';
import { words } from '../words/words.ts';
import { arrowOf, bytesText, meaning } from './describe.ts';
import { LogPanel } from './LaterLogPanel.tsx';
import { createStrip } from './strip.ts';
import { READABLE_MS } from '../ui/useFollow.ts';
import { PART } from '../ui/useParts.ts';
import styles from './LogDrawer.module.css';

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
      <button
        type="button"
        className={styles.button}
        aria-label={words.log.open}
        onClick={() => view.setState({ logOpen: true })}
        onKeyDown={pressOnce}
      >
        <Icon name="up" />
        <span className={styles.title}>{words.log.title}</span>
        <Latest />
      </button>
    </section>
  );
}

function Latest() {
  const { traffic } = useStores().device;
  const strip = useMemo(() => createStrip(traffic), [traffic]);
  const said = (): string => {
    const now = strip.latest();
    return now === null ? words.log.empty : `${arrowOf(now.entry)} ${meaning(now)}`;
  };
  const bytes = (): string => {
    const now = strip.latest();
    return now === null ? '' : bytesText(now);
  };
  const how = {
    ...{ isFixed: true, eachMs: READABLE_MS },
    isCalm: () => !strip.isStopped(),
    about: () => strip.latest()?.id,
  };
  return (
    <>
      <LiveText className={styles.latest} text={said} {...how} />
      <LiveText className={styles.bytes} text={bytes} {...how} />
    </>
  );
}
