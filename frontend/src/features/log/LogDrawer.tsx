// The log at the foot of the page: folded it is one line with the latest packet or the stop that holds, unfolded the whole log.

import { useStores, useView } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { later, usePart } from '../../ui/later.tsx';
import { pressOnce } from '../../ui/pressOnce.ts';
import { words } from '../../i18n/words.ts';
import { LogPanel } from './LaterLogPanel.tsx';
import { PART } from '../../ui/useParts.ts';
import styles from './LogDrawer.module.css';

/** What a packet means is many words: they come when the page is there, into a line that has its height already. */
const latest = later(async () => (await import('./LatestEntry.tsx')).LatestEntry);

export function LogDrawer() {
  const { view } = useStores();
  const isOpen = useView((state) => state.logOpen);
  const { part: LatestEntry } = usePart(latest, !isOpen);
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
        {LatestEntry !== null && <LatestEntry />}
      </button>
    </section>
  );
}
