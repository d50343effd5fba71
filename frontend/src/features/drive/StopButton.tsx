// STOP: acts on press, never asks, present while a link exists. It lies in react-aria's top layer, above every dialog, so that no modal
// dialog hides it. A click without a pointer (detail 0) comes from a screen reader. Esc does the same anywhere, also in text fields and
// dialogs.

import { useEffect, type KeyboardEvent as ReactKeyboardEvent } from 'react';
import type { Device } from '../../robot/device.ts';
import { useDevice, useStores } from '../stores.ts';
import { words } from '../../i18n/words.ts';
import styles from './StopButton.module.css';

export function StopButton() {
  const { device } = useStores();
  const exists = useDevice((state) => state.way !== null);
  useEscape(device);

  return (
    <div className={styles.place} data-react-aria-top-layer="true">
      <button
        type="button"
        className={styles.stop}
        aria-keyshortcuts="Escape"
        disabled={!exists}
        onPointerDown={() => device.halt()}
        onKeyDown={(event) => {
          if (!isActivation(event)) return;
          // The press has stopped the robot: prevents the click that would follow the key's release.
          event.preventDefault();
          if (!event.repeat) device.halt();
        }}
        onKeyUp={(event) => {
          if (isActivation(event)) event.preventDefault();
        }}
        onClick={(event) => {
          if (event.detail === 0) device.halt();
        }}
      >
        {words.stop.button}
        <kbd className={styles.key} aria-hidden="true">
          {words.stop.hint}
        </kbd>
      </button>
    </div>
  );
}

const isActivation = ({ key }: ReactKeyboardEvent): boolean => key === 'Enter' || key === ' ';

/** Listens in the capture phase, before a dialog or field can stop the event. */
function useEscape(device: Device): void {
  useEffect(() => {
    const halt = (event: KeyboardEvent): void => {
      if (event.key === 'Escape' && !event.repeat) device.halt();
    };
    window.addEventListener('keydown', halt, { capture: true });
    return () => window.removeEventListener('keydown', halt, { capture: true });
  }, [device]);
}
