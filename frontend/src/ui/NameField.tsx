// A name one edits in place; taken over on Enter or on leaving the field, if anything is left of it. Enter leaves the focus where it
// is; for a finger it ends the typing, so that its keyboard goes.

import { useLayoutEffect, useRef } from 'react';
import { cx } from './cx.ts';
import { isTouch } from './inputEvents.ts';
import styles from './NameField.module.css';

/** As long as the names of robots and groups. */
const MAX_LENGTH = 64;

export interface NameFieldProps {
  readonly label: string;
  readonly name: string;
  readonly isFramed?: boolean;
  readonly excludeFromTabOrder?: boolean;
  onRename(name: string): void;
}

export function NameField({
  label,
  name,
  isFramed = false,
  excludeFromTabOrder = false,
  onRename,
}: NameFieldProps) {
  const field = useRef<HTMLInputElement>(null);
  /** What was asked for last: leaving the field does not ask for it again. */
  const asked = useRef(name);

  useLayoutEffect(() => {
    asked.current = name;
    if (field.current !== null) field.current.value = name;
  }, [name]);

  function take(input: HTMLInputElement): void {
    const wanted = input.value.trim();
    if (wanted === '') input.value = name;
    else if (wanted !== asked.current) {
      asked.current = wanted;
      onRename(wanted);
    }
  }

  return (
    <input
      ref={field}
      className={cx(styles.name, isFramed && styles.framed)}
      aria-label={label}
      defaultValue={name}
      maxLength={MAX_LENGTH}
      autoComplete="off"
      spellCheck={false}
      {...(excludeFromTabOrder && { tabIndex: -1 })}
      onBlur={({ target }) => take(target)}
      onKeyDown={({ key, currentTarget }) => {
        if (key !== 'Enter') return;
        take(currentTarget);
        if (isTouch()) currentTarget.blur();
      }}
    />
  );
}
