// A name one edits in place; taken over on Enter or on leaving the field, if anything is left of it.

import { cx } from './cx.ts';
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
  return (
    <input
      key={name}
      className={cx(styles.name, isFramed && styles.framed)}
      aria-label={label}
      defaultValue={name}
      maxLength={MAX_LENGTH}
      autoComplete="off"
      spellCheck={false}
      {...(excludeFromTabOrder && { tabIndex: -1 })}
      onBlur={({ target }) => {
        const wanted = target.value.trim();
        if (wanted === '') target.value = name;
        else if (wanted !== name) onRename(wanted);
      }}
      onKeyDown={(event) => {
        if (event.key === 'Enter') event.currentTarget.blur();
      }}
    />
  );
}
