// The page of whoever may only stop: one button. It acts on press, as everywhere, and Esc does the same.

import { useEffect, useState } from 'react';
import type { PeopleError } from './people.ts';
import { peopleProblem } from './problem.ts';
import { words } from '../../i18n/whole.ts';
import styles from './Outside.module.css';

export type StopOutcome = 'idle' | 'sending' | 'sent' | PeopleError;

export function StopPage({ stop }: { stop(): Promise<StopOutcome> }) {
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
          // Keys and screen readers; a pointer has done it already.
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
