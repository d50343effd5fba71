// The stack of short messages, read out as they come. Far from STOP, and never over a control that is in use.

import { Button, IconButton } from './Button.tsx';
import { Mark, type Truth } from './Chip.tsx';
import styles from './Toasts.module.css';

export interface Toast {
  readonly id: number;
  readonly truth: Truth;
  readonly text: string;
  /** Pressing it dismisses the message too. */
  readonly action?: { readonly label: string; act(): void } | undefined;
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
            {toast.action !== undefined && <ActButton {...toast.action} onDone={() => onDismiss(toast.id)} />}
            <IconButton icon="close" label={dismissLabel} onPress={() => onDismiss(toast.id)} />
          </li>
        ))}
      </ol>
    </section>
  );
}

interface ActButtonProps {
  readonly label: string;
  act(): void;
  onDone(): void;
}

function ActButton({ label, act, onDone }: ActButtonProps) {
  return (
    <Button
      onPress={() => {
        onDone();
        act();
      }}
    >
      {label}
    </Button>
  );
}
