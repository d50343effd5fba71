// STOP: acts on press, needs no confirmation, present while a link exists. It lies in react-aria's top layer, above every dialog, so that no modal
// dialog hides it. A click without a pointer (detail 0) comes from a screen reader. Esc does the same anywhere, also in text fields and
// dialogs.

import { useEffect, type KeyboardEvent as ReactKeyboardEvent } from 'react';
import type { Device } from '../../robot/device.ts';
import { useDevice, useStores, type Stores } from '../stores.ts';
import { shortcutsOf, type Action } from '../../ui/action.ts';
import { words } from '../../i18n/words.ts';
import styles from './StopButton.module.css';

/** Its key is the only one that works everywhere; see `useStopKey`. */
export const STOP: Action<Pick<Stores, 'device'>> = {
  ...{ id: 'stop', icon: 'end', keys: ['Escape'] },
  label: () => words.stop.button,
  enabled: ({ device }) => device.store.getState().way !== null || words.servos.blocked.closed,
  run: ({ device }) => device.halt(),
};

export function StopButton() {
  const { device } = useStores();
  const exists = useDevice((state) => state.way !== null);
  useStopKey(device);

  return (
    <div className={styles.place} data-react-aria-top-layer="true">
      <button
        type="button"
        className={styles.stop}
        aria-keyshortcuts={shortcutsOf(STOP.keys)}
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

/** Listens while the event goes down, before any dialog or field can keep it. */
function useStopKey(device: Device): void {
  useEffect(() => {
    const halt = (event: KeyboardEvent): void => {
      // Whatever is held with it: in an emergency no other key is looked at.
      if (STOP.keys.includes(event.key) && !event.repeat) STOP.run({ device });
    };
    window.addEventListener('keydown', halt, { capture: true });
    return () => window.removeEventListener('keydown', halt, { capture: true });
  }, [device]);
}
