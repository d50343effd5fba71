// The form of whoever stands outside: what it is about, its fields, what went wrong, and one press that goes on.

import { useId, type InputHTMLAttributes, type ReactNode, type SyntheticEvent } from 'react';
import type { PeopleError } from './people.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { peopleProblem } from './problem.ts';
import styles from './Outside.module.css';

export interface EntryCardProps {
  readonly text: { readonly title: string; readonly about: string; readonly submit: string };
  /** Below the press. */
  readonly notes?: readonly string[];
  readonly problem: PeopleError | null;
  readonly isReady?: boolean;
  readonly children: ReactNode;
  onGoOn(): void;
}

export function EntryCard({ text, notes = [], problem, isReady = true, children, onGoOn }: EntryCardProps) {
  const title = useId();
  const submit = (event: SyntheticEvent): void => {
    event.preventDefault();
    if (isReady) onGoOn();
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

export function EntryField({ label, isLarge = false, onChange, ...input }: EntryFieldProps) {
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

/** `name` is what was typed; an empty one stands for what is suggested. */
export const nameOr = (suggested: string, name: string): string =>
  name.trim() === '' ? suggested : name.trim();

export const NAME_INPUT = { maxLength: 64, autoComplete: 'nickname' } as const;
