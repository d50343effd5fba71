// The log at the foot of the page: unfolded, or folded to one line with the latest packet in words and bytes, or the stop in effect.

import { useStores, useView } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { Icon } from '../../ui/Icon.tsx';
import { pressOnce } from '../../ui/inputEvents.ts';
import { PART } from '../../ui/focus.ts';
import { LogPanel } from './Messages.tsx';
import styles from './LogDrawer.module.css';
import { useMemo } from 'react';
import { LiveText } from '../../ui/LiveText.tsx';
import { READABLE_MS } from '../../ui/useEachFrame.ts';
import { arrowOf, bytesText, meaning } from './packetText.ts';
import type { Entry } from '#shared/files/recording.ts';
import type { LogEntry, TrafficLog } from '../../robot/traffic.ts';

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
        <LatestEntry />
      </button>
    </section>
  );
}

function LatestEntry() {
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

interface Strip {
  /** null if the log is empty. */
  latest(): LogEntry | null;
  /** True while it shows a stop, which must be readable at once. */
  isStopped(): boolean;
}

/** Chooses the newest entry, or the last stop while nothing may move: only its repeats, holds and the battery follow a stop. */
export function createStrip(log: TrafficLog): Strip {
  let readId = 0;
  let shown: LogEntry | null = null;
  let stopped = false;

  function read(): void {
    const { oldestId, nextId } = log.store.getState();
    if (nextId === oldestId) [shown, stopped] = [null, false];
    for (let id = Math.max(readId, oldestId); id < nextId; id++) {
      const newest = log.at(id);
      if (stopped && isPacket(newest.entry)) continue;
      shown = newest;
      stopped = isStop(newest.entry);
    }
    readId = nextId;
  }

  return {
    latest() {
      read();
      return shown;
    },
    isStopped() {
      read();
      return stopped;
    },
  };
}

const isPacket = (entry: Entry): boolean => 'bytes' in entry;

const isStop = (entry: Entry): boolean =>
  entry.mark === 'link' && (entry.happening === 'stopped' || entry.happening === 'latched');
