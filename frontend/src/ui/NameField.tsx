// A name edited in place; applied on Enter or when the field loses the focus, unless it is empty. Enter keeps the focus; on touch screens
// it blurs the field, so that the keyboard closes.

import { useLayoutEffect, useRef } from 'react';
import { cx } from './cx.ts';
import { isTouch } from './inputEvents.ts';
import styles from './NameField.module.css';

/** The longest name of robots and groups. */
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
  /** The name applied last, so that leaving the field does not apply it again. */
  const requested = useRef(name);

  useLayoutEffect(() => {
    requested.current = name;
    if (field.current !== null) field.current.value = name;
  }, [name]);

  function take(input: HTMLInputElement): void {
    const wanted = input.value.trim();
    if (wanted === '') input.value = name;
    else if (wanted !== requested.current) {
      requested.current = wanted;
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
