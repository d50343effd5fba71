// The packet log in words and bytes, newest last: it can be paused, searched, filtered by kind, saved and cleared. Packets are still recorded
// while it is paused. The list follows the newest line unless it is scrolled away; below it packets can be written by hand.

import {
  useId,
  useState,
  type SyntheticEvent,
  useDeferredValue,
  useMemo,
  useSyncExternalStore,
  memo,
  useLayoutEffect,
  useRef,
  type KeyboardEvent,
} from 'react';
import { useStore } from 'zustand';
import type { LogEntry } from '../../robot/traffic.ts';
import {
  bytesText,
  meaning,
  kindOf,
  lineText,
  judgeText,
  obstacleFor,
  type Judged,
  arrowOf,
} from './packetText.ts';
import { useDevice, useSnapshot, useStores, useView } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import type { LogKind } from '../view.ts';
import { useWords } from '../../i18n/words.ts';
import { createLogView, logFile } from './logView.ts';
import { saveFile } from '../../ui/localFiles.tsx';
import { PART } from '../../ui/focus.ts';
import field from '../../ui/Field.module.css';
import styles from './LogPanel.module.css';
import { Icon } from '../../ui/Icon.tsx';
import logList from './LogList.module.css';

/** Searches the words, and the bytes if the query is whole bytes in hex, with or without spaces. Ignores case. */
export function searchTest(query: string, locale: string): (entry: LogEntry) => boolean {
  const wanted = query.trim().toLocaleLowerCase(locale);
  if (wanted === '') return () => true;
  const bytes = bytesIn(wanted);
  return (entry) =>
    meaning(entry).toLocaleLowerCase(locale).includes(wanted) ||
    (bytes !== null && bytesText(entry).includes(bytes));
}

function bytesIn(query: string): string | null {
  const digits = query.replace(/\s+/gu, '');
  if (!/^(?:[0-9a-f]{2})+$/u.test(digits)) return null;
  return digits.toUpperCase().replace(/(..)(?!$)/gu, '$1 ');
}

/**
 * A packet written by hand: says while typing how the board would interpret it. The switch that allows sending is off each time the log
 * opens. The robot may still refuse the packet.
 */
function RawSender() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const snapshot = useSnapshot((state) => state);
  const [text, setText] = useState('');
  const [isConsented, setConsented] = useState(false);
  const judged = judgeText(text, family);
  const obstacle = obstacleFor(judged, snapshot);
  const packet = isConsented && obstacle === null ? judged.packet : null;
  return (
    <RawForm
      {...{ text, judged, obstacle, isConsented }}
      maySend={packet !== null}
      onText={setText}
      onConsent={setConsented}
      onSend={() => {
        if (packet !== null) device.sendRaw(packet);
      }}
    />
  );
}

interface RawFormProps {
  readonly text: string;
  readonly judged: Judged;
  /** Why no packet can be sent now. */
  readonly obstacle: string | null;
  readonly isConsented: boolean;
  readonly maySend: boolean;
  onText(text: string): void;
  onConsent(isConsented: boolean): void;
  onSend(): void;
}

export function RawForm({ text, judged, obstacle, isConsented, maySend, ...on }: RawFormProps) {
  const explanationId = useId();
  function submit(event: SyntheticEvent): void {
    event.preventDefault();
    on.onSend();
  }
  return (
    <form className={styles.form} aria-label={words.raw.title} onSubmit={submit}>
      <input
        className={cx(field.field, styles.field)}
        aria-label={words.raw.field}
        aria-describedby={explanationId}
        placeholder={words.raw.example}
        autoComplete="off"
        autoCapitalize="characters"
        spellCheck={false}
        value={text}
        onChange={(event) => on.onText(event.target.value)}
      />
      <p
        id={explanationId}
        className={cx(styles.explanation, judged.isRefused && styles.refused)}
        aria-live="polite"
      >
        {judged.explanation}
        {obstacle !== null && <span className={styles.obstacle}> {obstacle}</span>}
      </p>
      <Toggle label={words.raw.consent} isOn={isConsented} onChange={on.onConsent} />
      <Button type="submit" isDisabled={!maySend}>
        {words.raw.send}
      </Button>
    </form>
  );
}

const KINDS = ['move', 'group', 'battery', 'link', 'noise'] as const satisfies readonly LogKind[];

export function LogPanel({ onFold }: { readonly onFold?: () => void }) {
  const { device, notices } = useStores();
  const { nextId } = useStore(device.traffic.store);
  const [heldId, setHeldId] = useState<number | null>(null);
  const [query, setQuery] = useState('');
  const view = useLogView(useDeferredValue(query), heldId);

  const save = (): void => {
    const { family, way } = device.store.getState();
    saveFile(logFile(device.traffic, family.id, way?.label ?? '', new Date()));
  };
  const copy = (entry: LogEntry): void => {
    copyText(lineText(entry)).then(
      () => notices.show('info', words.log.copied),
      () => notices.show('warning', words.log.notCopied),
    );
  };

  return (
    <section {...PART} className={styles.panel} aria-label={words.log.title} data-fills="">
      <header className={styles.header}>
        <h2 className={styles.title}>{words.log.title}</h2>
        <Filter />
        <input
          type="search"
          className={cx(field.field, styles.search)}
          aria-label={words.log.search}
          placeholder={words.log.searchHint}
          autoComplete="off"
          spellCheck={false}
          value={query}
          onChange={(event) => setQuery(event.target.value)}
        />
        <span className={styles.note}>
          {countedText(view.passedCount, view.hiddenCount)}
          {heldId !== null && ` · ${words.log.paused({ count: nextId - heldId })}`}
        </span>
        <Button
          tone="quiet"
          icon={heldId === null ? 'pause' : 'play'}
          onPress={() => setHeldId(heldId === null ? nextId : null)}
        >
          {heldId === null ? words.log.pause : words.log.continue}
        </Button>
        <Button tone="quiet" icon="save" hint={words.log.saveHint} onPress={save}>
          {words.log.save}
        </Button>
        <Button tone="quiet" icon="trash" onPress={() => device.traffic.clear()}>
          {words.log.clear}
        </Button>
        {onFold !== undefined && <IconButton icon="down" label={words.log.fold} onPress={onFold} />}
      </header>
      <LogList entries={view.shown} hiddenCount={view.hiddenCount} onCopy={copy} />
      <RawSender />
    </section>
  );
}

function useLogView(query: string, heldId: number | null) {
  const { device } = useStores();
  const kinds = useView((state) => state.logKinds);
  const { locale } = useWords();
  const view = useMemo(() => {
    const isFound = searchTest(query, locale);
    const passes = (entry: LogEntry): boolean => kinds.includes(kindOf(entry)) && isFound(entry);
    return createLogView(device.traffic, passes, heldId ?? undefined);
  }, [device, kinds, query, heldId, locale]);
  return useSyncExternalStore(view.subscribe, view.getSnapshot);
}

/** Rejects if the browser forbids it; on an insecure address there is no clipboard. */
async function copyText(text: string): Promise<void> {
  await navigator.clipboard.writeText(text);
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

function countedText(passed: number, hidden: number): string {
  if (hidden === 0) return words.log.counted({ passed });
  return words.log.countedOf({ passed, all: passed + hidden });
}

/** Within this distance the list counts as scrolled to the end. */
const NEAR_PX = 24;

interface LogListProps {
  readonly entries: readonly LogEntry[];
  readonly hiddenCount: number;
  onCopy(entry: LogEntry): void;
}

function LogList({ entries, hiddenCount, onCopy }: LogListProps) {
  const list = useRef<HTMLDivElement>(null);
  const follows = useRef(true);
  useLayoutEffect(() => {
    if (follows.current && list.current !== null) list.current.scrollTop = list.current.scrollHeight;
  }, [entries]);
  return (
    <div
      ref={list}
      className={logList.list}
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
        <p className={logList.empty}>{hiddenCount === 0 ? words.log.empty : words.log.nothingFound}</p>
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
      <div className={cx(logList.line, styles[entry.mark])}>
        <time className={logList.time}>{words.dates.formatElapsed(entry.atMs)}</time>
        <span className={logList.arrow} role="img" aria-label={arrowWords(entry.mark)}>
          {arrowOf(entry)}
        </span>
        <span className={logList.meaning}>{meaning(logEntry)}</span>
        <code className={logList.bytes}>{bytesText(logEntry)}</code>
        <button
          type="button"
          className={logList.copy}
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
