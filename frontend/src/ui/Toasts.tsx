// The stack of short messages, read out as they come. Far from STOP, and never over a control that is in use.

import { IconButton } from './Button.tsx';
import { Mark, type Truth } from './Chip.tsx';
import styles from './Toasts.module.css';

export interface Toast {
  readonly id: number;
  readonly truth: Truth;
  readonly text: string;
}

export interface ToastsProps {
  readonly label: string;
  readonly dismissLabel: string;
  readonly toasts: readonly Toast[];
  onDismiss(id: number): void;
}

export function Toasts({ label, dismissLabel, toasts, onDismiss }: ToastsProps) {
  return (
    <section className={styles.stack} aria-label={label} data-react-aria-top-layer="true">
      <ol aria-live="polite" className={styles.list}>
        {toasts.map((toast) => (
          <li key={toast.id} className={styles.toast}>
            <Mark truth={toast.truth} />
            <p className={styles.text}>{toast.text}</p>
            <IconButton icon="close" label={dismissLabel} onPress={() => onDismiss(toast.id)} />
          </li>
        ))}
      </ol>
    </section>
  );
}
