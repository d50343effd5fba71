// A button that stays pressed: a switch for tight places.

import { ToggleButton as AriaToggleButton } from 'react-aria-components/ToggleButton';
import type { ReactNode } from 'react';
import { hinted } from './Hints.tsx';
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
    <AriaToggleButton
      {...(hint === undefined ? {} : hinted(hint))}
      className={styles.button ?? ''}
      isSelected={isOn}
      onChange={onChange}
    >
      {children}
    </AriaToggleButton>
  );
}
