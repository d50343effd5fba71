// Short messages, announced to screen readers: the newest is shown, older ones are counted. Has its own space and covers nothing; above
// dialogs and usable beside them. Dismissing one restores the focus.

import { useRef } from 'react';
import { Button, IconButton } from './Button.tsx';
import { Mark, type Truth } from './Chip.tsx';
import styles from './Toasts.module.css';

export interface Toast {
  readonly id: number;
  readonly truth: Truth;
  readonly text: string;
  /** Pressing the button also dismisses the message. */
  readonly action?: { readonly label: string; act(): void } | undefined;
}

export interface ToastsProps {
  readonly label: string;
  readonly dismissLabel: string;
  /** The label for the number of older messages. */
  moreLabel(count: number): string;
  readonly toasts: readonly Toast[];
  onDismiss(id: number): void;
}

export function Toasts({ label, dismissLabel, moreLabel, toasts, onDismiss }: ToastsProps) {
  const waiting = toasts.length - 1;
  const cameFrom = useRef<HTMLElement | null>(null);
  const dismiss = (id: number): void => {
    onDismiss(id);
    cameFrom.current?.focus();
  };
  return (
    <section
      className={styles.place}
      aria-label={label}
      data-react-aria-top-layer="true"
      onFocus={({ currentTarget, relatedTarget }) => {
        if (currentTarget.contains(relatedTarget)) return;
        cameFrom.current = relatedTarget instanceof HTMLElement ? relatedTarget : null;
      }}
    >
      <ol aria-live="polite">
        {toasts.map((toast, index) => (
          <li key={toast.id} className={styles.toast} hidden={index < waiting}>
            <Mark truth={toast.truth} />
            <p className={styles.text}>{toast.text}</p>
            {waiting > 0 && <span className={styles.more}>{moreLabel(waiting)}</span>}
            {toast.action !== undefined && <ActButton {...toast.action} onDone={() => dismiss(toast.id)} />}
            <IconButton icon="close" label={dismissLabel} onPress={() => dismiss(toast.id)} />
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
