// The page of devices that do not see the dashboard: pairing of an unknown device, the button of a stop-only link, or a guest's name.

import {
  useId,
  type InputHTMLAttributes,
  type ReactNode,
  type SyntheticEvent,
  useState,
  useEffect,
} from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { PeopleError, peopleProblem } from './people.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import type { PairWish } from '#shared/client/http.generated.ts';
import { useSpokenLocale } from '../../i18n/words.ts';
import styles from './EntryPage.module.css';

interface EntryCardProps {
  readonly text: { readonly title: string; readonly about: string; readonly submit: string };
  /** Shown below the button. */
  readonly notes?: readonly string[];
  readonly problem: PeopleError | null;
  readonly isReady?: boolean;
  readonly children: ReactNode;
  onContinue(): void;
}

function EntryCard({ text, notes = [], problem, isReady = true, children, onContinue }: EntryCardProps) {
  const title = useId();
  const submit = (event: SyntheticEvent): void => {
    event.preventDefault();
    if (isReady) onContinue();
  };
  return (
    <form className={styles.card} onSubmit={submit} aria-labelledby={title}>
      <h1 id={title} className={styles.title}>
        {text.title}
      </h1>
      <p>{text.about}</p>
      {children}
      {problem !== null && (
        <p className={styles.problem} role="alert">
          {peopleProblem(problem.code, problem.message)}
        </p>
      )}
      <Button type="submit" tone="primary" wide isDisabled={!isReady}>
        {text.submit}
      </Button>
      {notes.map((note) => (
        <p key={note} className={styles.dim}>
          {note}
        </p>
      ))}
    </form>
  );
}

interface EntryFieldProps extends Omit<InputHTMLAttributes<HTMLInputElement>, 'onChange' | 'className'> {
  readonly label: string;
  readonly isLarge?: boolean;
  onChange(value: string): void;
}

function EntryField({ label, isLarge = false, onChange, ...input }: EntryFieldProps) {
  return (
    <label className={styles.field}>
      {label}
      <input
        {...input}
        className={cx(styles.input, isLarge && styles.large)}
        onChange={({ target }) => onChange(target.value)}
      />
    </label>
  );
}

/** The typed name, or the suggestion if it is empty. */
const nameOr = (suggested: string, name: string): string => (name.trim() === '' ? suggested : name.trim());

const NAME_INPUT = { maxLength: 64, autoComplete: 'nickname' } as const;

interface NameCardProps {
  readonly suggested: string;
  readonly problem: PeopleError | null;
  onName(name: string): void;
}

/** The guest of a link enters a name. A suggestion is filled in, so that one press continues. */
export function NameCard({ suggested, problem, onName }: NameCardProps) {
  const [name, setName] = useState(suggested);
  return (
    <EntryCard text={words.people.named} problem={problem} onContinue={() => onName(nameOr(suggested, name))}>
      <EntryField
        {...NAME_INPUT}
        label={words.people.pair.name}
        value={name}
        autoFocus
        onFocus={({ target }) => target.select()}
        onChange={setName}
      />
    </EntryCard>
  );
}

interface PairCardProps {
  readonly problem: PeopleError | null;
  readonly overheard: boolean;
  /** The name of a device that gives none. */
  readonly suggested: string;
  onPair(wish: PairWish): void;
}

/** On an unpaired device: the eight digits of its invitation. A reload afterwards opens the dashboard. */
export function PairCard({ problem, overheard, suggested, onPair }: PairCardProps) {
  const [name, setName] = useState('');
  const [code, setCode] = useState('');
  const digits = code.replaceAll(/\D/g, '');
  return (
    <EntryCard
      text={words.people.pair}
      notes={[words.people.pair.first, ...(overheard ? [words.people.overheard] : [])]}
      problem={problem}
      isReady={digits.length === 8}
      onContinue={() => onPair({ code: digits, name: nameOr(suggested, name) })}
    >
      <EntryField
        {...NAME_INPUT}
        label={words.people.pair.name}
        value={name}
        placeholder={suggested}
        onChange={setName}
      />
      <EntryField
        isLarge
        label={words.people.pair.code}
        value={code}
        inputMode="numeric"
        autoComplete="one-time-code"
        maxLength={9}
        onChange={setCode}
      />
    </EntryCard>
  );
}

export type StopOutcome = 'idle' | 'sending' | 'sent' | PeopleError;

/** The page for the role “stopper”: one button that acts on press. Esc does the same. */
function StopPage({ stop }: { stop(): Promise<StopOutcome> }) {
  const [outcome, setOutcome] = useState<StopOutcome>('idle');
  const press = (): void => {
    setOutcome('sending');
    void stop().then(setOutcome);
  };
  useEffect(() => {
    const onKey = (event: KeyboardEvent): void => {
      if (event.key === 'Escape' && !event.repeat) press();
    };
    window.addEventListener('keydown', onKey, { capture: true });
    return () => window.removeEventListener('keydown', onKey, { capture: true });
  });
  return <StopFace outcome={outcome} onPress={press} />;
}

export function StopFace({ outcome, onPress }: { readonly outcome: StopOutcome; onPress(): void }) {
  return (
    <div className={styles.stopOnly}>
      <h1 className={styles.title}>{words.people.stopOnly.title}</h1>
      <p className={styles.dim}>{words.people.stopOnly.about}</p>
      <button
        type="button"
        className={styles.stop}
        aria-keyshortcuts="Escape"
        onPointerDown={onPress}
        onClick={(event) => {
          // For keys and screen readers; a pointer has already triggered it.
          if (event.detail === 0) onPress();
        }}
      >
        {words.stop.button}
      </button>
      <p className={styles.outcome} role="status">
        {outcomeText(outcome)}
      </p>
    </div>
  );
}

function outcomeText(outcome: StopOutcome): string {
  if (outcome === 'idle') return '';
  if (outcome === 'sending') return words.people.stopOnly.sending;
  if (outcome === 'sent') return words.people.stopOnly.sent;
  if (outcome.code === 'refused') return words.people.stopOnly.unheard({ detail: outcome.message });
  return peopleProblem(outcome.code, outcome.message);
}

interface EntryPageProps {
  readonly mayStop: boolean;
  readonly overheard: boolean;
  readonly suggested: string;
  readonly problem: PeopleError | null;
  /** Pairs the device and reloads the page. Rejects with a PeopleError. */
  pair(wish: PairWish): Promise<void>;
  stop(): Promise<void>;
}

export function EntryPage({ mayStop, overheard, suggested, problem, pair, stop }: EntryPageProps) {
  const [failed, setFailed] = useState(problem);
  return (
    <Alone>
      {mayStop ? (
        <StopPage stop={() => stop().then(() => 'sent' as const, toProblem)} />
      ) : (
        <PairCard
          problem={failed}
          overheard={overheard}
          suggested={suggested}
          onPair={(wish) => void pair(wish).catch((error: unknown) => setFailed(toProblem(error)))}
        />
      )}
    </Alone>
  );
}

interface GuestProps {
  readonly suggested: string;
  /** Sets the name and opens the dashboard. Rejects with a PeopleError. */
  enter(name: string): Promise<void>;
}

/** A guest who was admitted by a link. */
export function Guest({ suggested, enter }: GuestProps) {
  const [problem, setProblem] = useState<PeopleError | null>(null);
  return (
    <Alone>
      <NameCard
        suggested={suggested}
        problem={problem}
        onName={(name) => void enter(name).catch((error: unknown) => setProblem(toProblem(error)))}
      />
    </Alone>
  );
}

function Alone({ children }: { readonly children: ReactNode }) {
  const locale = useSpokenLocale();
  return (
    <I18nProvider locale={locale}>
      <main className={styles.page}>{children}</main>
    </I18nProvider>
  );
}

function toProblem(error: unknown): PeopleError {
  if (error instanceof PeopleError) return error;
  throw error;
}
