// The lines of the log. At most the newest 200 are drawn; the list follows the newest one unless it was scrolled away.

import { memo, useLayoutEffect, useRef } from 'react';
import type { LogEntry } from '../stores/traffic.ts';
import { cx } from '../ui/cx.ts';
import { words } from '../words/en.ts';
import { formatElapsed } from '../words/numbers.ts';
import { bytesText, meaning } from './describe.ts';
import styles from './LogList.module.css';

const DRAWN = 200;
/** Closer to the end than this counts as "at the end". */
const NEAR_PX = 24;

export function LogList({ entries }: { readonly entries: readonly LogEntry[] }) {
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
      onScroll={({ currentTarget: { scrollTop, scrollHeight, clientHeight } }) => {
        follows.current = scrollHeight - clientHeight - scrollTop < NEAR_PX;
      }}
    >
      {entries.length === 0 && <p className={styles.empty}>{words.log.empty}</p>}
      {entries.slice(-DRAWN).map((entry) => (
        <Line key={entry.id} entry={entry} />
      ))}
    </div>
  );
}

const Line = memo(function Line({ entry: { traffic } }: { readonly entry: LogEntry }) {
  const isOut = traffic.direction === 'out';
  const isNoise = 'noise' in traffic;
  return (
    <div className={cx(styles.line, isNoise ? styles.noise : isOut ? styles.out : styles.in)}>
      <time className={styles.time}>{formatElapsed(traffic.atMs)}</time>
      <span className={styles.arrow} role="img" aria-label={isOut ? words.log.sent : words.log.received}>
        {isOut ? '→' : '←'}
      </span>
      <span className={styles.meaning}>{meaning(traffic)}</span>
      <code className={styles.bytes}>{bytesText(traffic)}</code>
    </div>
  );
});
