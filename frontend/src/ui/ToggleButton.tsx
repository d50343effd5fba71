// A button that stays pressed. Apart from Toggle.tsx, which is in the first load.

import type { ReactNode } from 'react';
import { hinted } from './hinting.ts';
import { pressOnce } from './inputEvents.ts';
import styles from './ToggleButton.module.css';

interface ToggleButtonProps {
  readonly isOn: boolean;
  /** More than the label says. */
  readonly hint?: string;
  readonly children: ReactNode;
  onChange(isOn: boolean): void;
}

export function ToggleButton({ isOn, hint, children, onChange }: ToggleButtonProps) {
  return (
    <button
      {...hinted({ hint })}
      type="button"
      className={styles.button}
      aria-pressed={isOn}
      onClick={() => onChange(!isOn)}
      onKeyDown={pressOnce}
    >
      {children}
    </button>
  );
}
