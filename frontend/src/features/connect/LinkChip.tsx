// The link in one word with one shape, and the one obvious Connect. Pressing it opens the ways to connect.

import { useDevice, useSnapshot, useStores } from '../stores.ts';
import { Mark, type Truth } from '../../ui/Chip.tsx';
import { Button } from '../../ui/Button.tsx';
import { pressOnce } from '../../ui/inputEvents.ts';
import type { LinkState } from '#shared/robot/state.ts';
import { words } from '../../i18n/words.ts';
import styles from './LinkChip.module.css';

const TRUTH: Readonly<Record<LinkState['status'], Truth>> = {
  closed: 'neutral',
  opening: 'unknown',
  identifying: 'unknown',
  ready: 'confirmed',
  stale: 'warning',
  lost: 'danger',
  refused: 'danger',
};

export function LinkChip() {
  const { view } = useStores();
  const status = useSnapshot((snapshot) => snapshot.link.status);
  const mustChoose = useSnapshot(({ link }) => link.status === 'refused' && link.error.code === 'closed');
  const way = useDevice((state) => state.way);
  const isSimulated = way?.isSimulated === true;
  const connects = way === null || isSimulated || mustChoose;
  const open = (): void => view.setState({ connectOpen: true });
  const label = way === null || isSimulated ? '' : way.label;
  const said = isSimulated ? words.link.simulated : words.link.status[status];
  return (
    <div className={styles.link} data-connects={connects}>
      <button
        type="button"
        className={styles.chip}
        aria-label={
          label === '' ? words.link.chip({ status: said }) : words.link.chipWithPort({ status: said, label })
        }
        onClick={open}
        onKeyDown={pressOnce}
      >
        <Mark truth={TRUTH[status]} />
        <span className={styles.word}>{words.link.status[status]}</span>
        {isSimulated ? (
          <span className={styles.badge}>{words.link.simulated}</span>
        ) : (
          <span className={styles.label}>{label}</span>
        )}
      </button>
      {connects && (
        <Button tone={status === 'ready' ? 'plain' : 'primary'} icon="plug" onPress={open}>
          {words.link.connect}
        </Button>
      )}
    </div>
  );
}
