// What a link's guest sees first: what the others shall call them, filled in, so that one press goes on.

import { useId, useState, type SyntheticEvent } from 'react';
import type { PeopleError } from '../stores/people.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './Outside.module.css';

export interface NameCardProps {
  readonly suggested: string;
  readonly problem: PeopleError | null;
  onName(name: string): void;
}

export function NameCard({ suggested, problem, onName }: NameCardProps) {
  const title = useId();
  const [name, setName] = useState(suggested);
  const submit = (event: SyntheticEvent): void => {
    event.preventDefault();
    onName(name.trim() === '' ? suggested : name.trim());
  };
  return (
    <form className={styles.card} onSubmit={submit} aria-labelledby={title}>
      <h1 id={title} className={styles.title}>
        {words.people.named.title}
      </h1>
      <p>{words.people.named.about}</p>
      <label className={styles.field}>
        {words.people.pair.name}
        <input
          className={styles.input}
          value={name}
          maxLength={64}
          autoComplete="nickname"
          autoFocus
          onFocus={({ target }) => target.select()}
          onChange={({ target }) => setName(target.value)}
        />
      </label>
      {problem !== null && (
        <p className={styles.problem} role="alert">
          {words.people.problem(problem.code, problem.message)}
        </p>
      )}
      <Button type="submit" tone="primary" wide>
        {words.people.named.submit}
      </Button>
    </form>
  );
}
