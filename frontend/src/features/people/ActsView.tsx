// What people did at the gateway: a list with filters, read by pages, and its export. Plain values and callbacks.

import type { AuditEntry } from '#shared/client/http.generated.ts';
import { words } from '../../i18n/whole.ts';
import { Button } from '../../ui/Button.tsx';
import { EmptyState } from '../../ui/Panel.tsx';
import { Select } from '../../ui/Select.tsx';
import { actNames, detailsOf, type Act, type ActFilter, type ActsState } from './acts.ts';
import styles from './Acts.module.css';

interface ActsViewProps {
  readonly state: ActsState;
  onFilter(filter: ActFilter): void;
  onOlder(): void;
  onExport(): void;
}

export function ActsView({ state, onFilter, onOlder, onExport }: ActsViewProps) {
  const { entries, hasOlder, problem } = state;
  return (
    <div className={styles.acts}>
      <Filters state={state} onFilter={onFilter} onExport={onExport} />
      {problem !== null && (
        <p role="status" className={styles.problem}>
          {words.acts.notStored({ problem })}
        </p>
      )}
      {entries?.length === 0 && <Nothing filter={state.filter} />}
      {entries !== null && entries.length > 0 && (
        <ol className={styles.list} aria-label={words.acts.list}>
          {entries.map((entry) => (
            <ActRow key={entry.id} entry={entry} />
          ))}
        </ol>
      )}
      {hasOlder && (
        <div>
          <Button tone="quiet" icon="down" onPress={onOlder}>
            {words.acts.older}
          </Button>
        </div>
      )}
    </div>
  );
}

type FiltersProps = Pick<ActsViewProps, 'state' | 'onFilter' | 'onExport'>;

function Filters({ state: { filter, names, entries }, onFilter, onExport }: FiltersProps) {
  const acts = actNames().map((value) => ({ value, label: words.acts.kinds[value] }));
  // A person whose last entry has left the list may still be chosen.
  const people = [...new Set([...names, ...(filter.who === '' ? [] : [filter.who])])];
  return (
    <div className={styles.filters}>
      <Select<Act | ''>
        label={words.acts.act}
        value={filter.act}
        options={[{ value: '', label: words.acts.allActs }, ...acts]}
        onChange={(act) => onFilter({ ...filter, act })}
      />
      <Select
        label={words.acts.who}
        value={filter.who}
        options={[
          { value: '', label: words.acts.everyone },
          ...people.map((name) => ({ value: name, label: name })),
        ]}
        onChange={(who) => onFilter({ ...filter, who })}
      />
      <Button icon="download" isDisabled={entries === null || entries.length === 0} onPress={onExport}>
        {words.acts.export}
      </Button>
    </div>
  );
}

function Nothing({ filter: { act, who } }: { readonly filter: ActFilter }) {
  return act === '' && who === '' ? (
    <EmptyState title={words.acts.empty} hint={words.acts.emptyHint} />
  ) : (
    <EmptyState title={words.acts.noneFound} hint={words.acts.noneFoundHint} />
  );
}

function actorOf({ act, who }: AuditEntry): string {
  return who ?? (act === 'pairRefused' ? words.acts.unknown : words.acts.gateway);
}

function ActRow({ entry }: { readonly entry: AuditEntry }) {
  return (
    <li className={styles.row}>
      <time className={styles.dim} dateTime={new Date(entry.atMs).toISOString()}>
        {words.dates.formatMoment(entry.atMs)}
      </time>
      <span className={styles.who}>{actorOf(entry)}</span>
      <span className={styles.what}>
        {words.acts.kinds[entry.act]} <span className={styles.dim}>{detailsOf(entry)}</span>
      </span>
    </li>
  );
}
