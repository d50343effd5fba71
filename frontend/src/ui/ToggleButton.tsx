// A button that stays pressed: a switch for tight places.

import type { ReactNode } from 'react';
import { hinted } from './hinting.ts';
import { pressOnce } from './pressOnce.ts';
import styles from './ToggleButton.module.css';

export interface ToggleButtonProps {
  readonly isOn: boolean;
  /** What the word alone does not say. */
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
