// What a device that is not paired sees: one card to type the eight digits into. A reload afterwards opens the page as ever.

import { useId, useState, type SyntheticEvent } from 'react';
import type { PeopleError } from '../stores/people.ts';
import type { PairWish } from '../stores/people.generated.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './Outside.module.css';

export interface PairCardProps {
  readonly problem: PeopleError | null;
  readonly overheard: boolean;
  /** The name of whoever says none. */
  readonly suggested: string;
  onPair(wish: PairWish): void;
}

export function PairCard({ problem, overheard, suggested, onPair }: PairCardProps) {
  const title = useId();
  const [name, setName] = useState('');
  const [code, setCode] = useState('');
  const digits = code.replaceAll(/\D/g, '');
  const submit = (event: SyntheticEvent): void => {
    event.preventDefault();
    if (digits.length === 8) onPair({ code: digits, name: name.trim() === '' ? suggested : name.trim() });
  };
  return (
    <form className={styles.card} onSubmit={submit} aria-labelledby={title}>
      <h1 id={title} className={styles.title}>
        {words.people.pair.title}
      </h1>
      <p>{words.people.pair.about}</p>
      <label className={styles.field}>
        {words.people.pair.name}
        <input
          className={styles.input}
          value={name}
          placeholder={suggested}
          maxLength={64}
          autoComplete="nickname"
          onChange={({ target }) => setName(target.value)}
        />
      </label>
      <label className={styles.field}>
        {words.people.pair.code}
        <input
          className={styles.code}
          value={code}
          inputMode="numeric"
          autoComplete="one-time-code"
          maxLength={9}
          onChange={({ target }) => setCode(target.value)}
        />
      </label>
      {problem !== null && (
        <p className={styles.problem} role="alert">
          {words.people.problem(problem.code, problem.message)}
        </p>
      )}
      <Button type="submit" tone="primary" wide isDisabled={digits.length !== 8}>
        {words.people.pair.submit}
      </Button>
      <p className={styles.dim}>{words.people.pair.first}</p>
      {overheard && <p className={styles.dim}>{words.people.overheard}</p>}
    </form>
  );
}
