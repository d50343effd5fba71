// The red button: acts on press, needs no confirmation, and Esc does the same anywhere, also in text fields and dialogs. It lies in
// react-aria's top layer, above every dialog, so that no modal dialog hides it. A click without a pointer (detail 0) comes from a screen
// reader. Knows nothing of what it stops.

import { useEffect, useEffectEvent, type KeyboardEvent as ReactKeyboardEvent, type ReactNode } from 'react';
import { words } from '../i18n/words.ts';
import { shortcutsOf } from './action.ts';
import styles from './StopKey.module.css';

export const STOP_KEYS = ['Escape'] as const;

interface StopKeyProps {
  readonly label: string;
  readonly isDisabled: boolean;
  onStop(): void;
}

export function StopKey({ label, isDisabled, onStop }: StopKeyProps) {
  useStopKey(onStop);
  return (
    <div className={styles.place} data-react-aria-top-layer="true">
      <StopPress keys={STOP_KEYS} isDisabled={isDisabled} onStop={onStop}>
        {label}
        <kbd className={styles.key} aria-hidden="true">
          {words.stop.hint}
        </kbd>
      </StopPress>
    </div>
  );
}

interface StopPressProps extends Omit<StopKeyProps, 'label'> {
  readonly keys?: readonly string[];
  readonly children: ReactNode;
}

/** The button itself, wherever it is. */
export function StopPress({ keys = [], isDisabled, children, onStop }: StopPressProps) {
  return (
    <button
      type="button"
      className={styles.stop}
      {...(keys.length > 0 && { 'aria-keyshortcuts': shortcutsOf(keys) })}
      disabled={isDisabled}
      onPointerDown={onStop}
      onKeyDown={(event) => {
        if (!isActivation(event)) return;
        // The press has stopped the robot: prevents the click that would follow the key's release.
        event.preventDefault();
        if (!event.repeat) onStop();
      }}
      onKeyUp={(event) => {
        if (isActivation(event)) event.preventDefault();
      }}
      onClick={(event) => {
        if (event.detail === 0) onStop();
      }}
    >
      {children}
    </button>
  );
}

const isActivation = ({ key }: ReactKeyboardEvent): boolean => key === 'Enter' || key === ' ';

/** Listens while the event goes down, before any dialog or field can keep it. */
function useStopKey(onStop: () => void): void {
  const stop = useEffectEvent(onStop);
  useEffect(() => {
    const press = ({ key, repeat }: KeyboardEvent): void => {
      // Whatever is held with it: in an emergency no other key is looked at.
      if (key === STOP_KEYS[0] && !repeat) stop();
    };
    window.addEventListener('keydown', press, { capture: true });
    return () => window.removeEventListener('keydown', press, { capture: true });
  }, []);
}
