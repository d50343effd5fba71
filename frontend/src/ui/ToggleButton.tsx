// A button that stays pressed: a switch for tight places.

import { ToggleButton as AriaToggleButton } from 'react-aria-components/ToggleButton';
import type { ReactNode } from 'react';
import styles from './ToggleButton.module.css';

export interface ToggleButtonProps {
  readonly isOn: boolean;
  readonly children: ReactNode;
  onChange(isOn: boolean): void;
}

export function ToggleButton({ isOn, children, onChange }: ToggleButtonProps) {
  return (
    <AriaToggleButton className={styles.button ?? ''} isSelected={isOn} onChange={onChange}>
      {children}
    </AriaToggleButton>
  );
}
