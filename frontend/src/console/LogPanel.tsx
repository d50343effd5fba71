// The packet log: what went over the link, in words and in bytes, newest last. It can be paused, cleared and thinned out by
// kind; paused, packets go on being collected.

import { useState } from 'react';
import { useStore } from 'zustand';
import type { LogEntry } from '../stores/traffic.ts';
import { useStores, useView } from '../stores/stores.ts';
import type { LogKind } from '../stores/view.ts';
import { Button, IconButton } from '../ui/Button.tsx';
import { words } from '../words/en.ts';
import { LogList } from './LogList.tsx';
import { kindOf } from './describe.ts';
import styles from './LogPanel.module.css';

const KINDS = ['move', 'group', 'battery', 'noise'] as const satisfies readonly LogKind[];

export function LogPanel({ onFold }: { readonly onFold?: () => void }) {
  const { device } = useStores();
  const live = useStore(device.traffic.store);
  const [frozen, setFrozen] = useState<readonly LogEntry[] | null>(null);
  const kinds = useView((state) => state.logKinds);
  const shown = (frozen ?? live).filter((entry) => kinds.includes(kindOf(entry.traffic)));
  const missed = (live.at(-1)?.id ?? 0) - (frozen?.at(-1)?.id ?? 0);
  return (
    <section className={styles.panel} aria-label={words.log.title} data-fills="">
      <header className={styles.header}>
        <h2 className={styles.title}>{words.log.title}</h2>
        <Filter />
        <span className={styles.note}>{frozen === null ? '' : words.log.paused(missed)}</span>
        <Button
          tone="quiet"
          icon={frozen === null ? 'pause' : 'play'}
          onPress={() => setFrozen(frozen === null ? live : null)}
        >
          {frozen === null ? words.log.pause : words.log.goOn}
        </Button>
        <Button tone="quiet" icon="trash" onPress={() => device.traffic.clear()}>
          {words.log.clear}
        </Button>
        {onFold !== undefined && <IconButton icon="down" label={words.log.fold} onPress={onFold} />}
      </header>
      <LogList entries={shown} />
    </section>
  );
}

function Filter() {
  const { view } = useStores();
  const kinds = useView((state) => state.logKinds);
  const toggle = (kind: LogKind): void =>
    view.setState({
      logKinds: kinds.includes(kind) ? kinds.filter((other) => other !== kind) : [...kinds, kind],
    });
  return (
    <fieldset className={styles.filter} aria-label={words.log.filter}>
      {KINDS.map((kind) => (
        <label key={kind} className={styles.kind}>
          <input type="checkbox" checked={kinds.includes(kind)} onChange={() => toggle(kind)} />
          {words.log.kinds[kind]}
        </label>
      ))}
    </fieldset>
  );
}
