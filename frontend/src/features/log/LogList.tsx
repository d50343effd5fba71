// The lines of the log. The list follows the newest line unless it is scrolled away; arrow keys go from line to line, Enter copies one.

import { memo, useLayoutEffect, useRef, type KeyboardEvent } from 'react';
import type { LogEntry } from '../../robot/traffic.ts';
import { Icon } from '../../ui/Icon.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import { useWords } from '../../i18n/words.ts';
import { arrowOf, bytesText, meaning } from './packetText.ts';
import styles from './LogList.module.css';

/** Within this distance the list counts as scrolled to the end. */
const NEAR_PX = 24;

interface LogListProps {
  readonly entries: readonly LogEntry[];
  readonly hiddenCount: number;
  onCopy(entry: LogEntry): void;
}

export function LogList({ entries, hiddenCount, onCopy }: LogListProps) {
  const list = useRef<HTMLDivElement>(null);
  const follows = useRef(true);
  useLayoutEffect(() => {
    if (follows.current && list.current !== null) list.current.scrollTop = list.current.scrollHeight;
  }, [entries]);
  return (
    <div
      ref={list}
      className={styles.list}
      role="log"
      aria-live="off"
      aria-label={words.log.entries}
      tabIndex={0}
      onKeyDown={walk}
      onScroll={({ currentTarget: { scrollTop, scrollHeight, clientHeight } }) => {
        follows.current = scrollHeight - clientHeight - scrollTop < NEAR_PX;
      }}
    >
      {entries.length === 0 && (
        <p className={styles.empty}>{hiddenCount === 0 ? words.log.empty : words.log.nothingFound}</p>
      )}
      {entries.map((entry) => (
        <Line key={entry.id} logEntry={entry} onCopy={onCopy} />
      ))}
    </div>
  );
}

/** Goes from line to line; from the list itself to the newest line. */
function walk(event: KeyboardEvent<HTMLDivElement>): void {
  const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
  if (step === undefined) return;
  const lines = [...event.currentTarget.querySelectorAll('button')];
  const at = lines.findIndex((line) => line === document.activeElement);
  const next = at < 0 ? lines.at(-1) : lines[at + step];
  event.preventDefault();
  next?.focus();
}

interface LineProps {
  readonly logEntry: LogEntry;
  onCopy(entry: LogEntry): void;
}

const Line = memo(
  function Line({ logEntry, onCopy }: LineProps) {
    const { entry } = logEntry;
    useWords();
    return (
      <div className={cx(styles.line, styles[entry.mark])}>
        <time className={styles.time}>{words.dates.formatElapsed(entry.atMs)}</time>
        <span className={styles.arrow} role="img" aria-label={arrowWords(entry.mark)}>
          {arrowOf(entry)}
        </span>
        <span className={styles.meaning}>{meaning(logEntry)}</span>
        <code className={styles.bytes}>{bytesText(logEntry)}</code>
        <button
          type="button"
          className={styles.copy}
          tabIndex={-1}
          aria-label={words.log.copy}
          onClick={() => onCopy(logEntry)}
        >
          <Icon name="copy" />
        </button>
      </div>
    );
  },
  (before, after) => before.logEntry === after.logEntry,
);

function arrowWords(mark: LogEntry['entry']['mark']): string {
  if (mark === 'link' || mark === 'board') return words.log.link;
  return mark === 'sent' ? words.log.sent : words.log.received;
}
