// STOP: acts on press, never asks, is there while a link exists. It lies in the library's top layer, above every dialog, so
// nothing modal can take it away. A click without a pointer (detail 0) comes from a screen reader. Esc does the same from anywhere, a text field or a dialog included.

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
          // The press has done it: the click that the key's release would bring is not wanted.
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

/** Listens while the event goes down, before any dialog or field can keep it. */
function useEscape(device: Device): void {
  useEffect(() => {
    const halt = (event: KeyboardEvent): void => {
      if (event.key === 'Escape' && !event.repeat) device.halt();
    };
    window.addEventListener('keydown', halt, { capture: true });
    return () => window.removeEventListener('keydown', halt, { capture: true });
  }, [device]);
}
