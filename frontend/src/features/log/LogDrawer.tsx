// The log at the foot of the page: folded to the latest entry, or unfolded.

import { later, usePart } from '../../ui/later.tsx';
import { useStores, useView } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { Icon } from '../../ui/Icon.tsx';
import { pressOnce } from '../../ui/inputEvents.ts';
import { PART } from '../../ui/focus.ts';
import { LogPanel } from './Messages.tsx';
import styles from './LogDrawer.module.css';

/** The words for packets are loaded after the page; the line already has its height. */
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
