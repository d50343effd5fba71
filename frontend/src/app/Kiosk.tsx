// Only the buttons, the current activity, and STOP, which the page puts beside them. To leave takes a long press: no child comes
// upon that by chance, and no reload is a way around it.

import { useEffect, useRef, useState } from 'react';
import { Messages } from '../features/log/Messages.tsx';
import { useMacros, useStores } from '../features/stores.ts';
import { StatusLine, type StatusLineProps } from '../features/connect/StatusLine.tsx';
import { words } from '../i18n/whole.ts';
import { NoButtons } from '../features/buttons/ButtonsPage.tsx';
import { MacroGrid } from '../features/buttons/MacroGrid.tsx';
import styles from './Kiosk.module.css';

export function Kiosk({ onMoveHere }: StatusLineProps) {
  const isEmpty = useMacros(({ present }) => present.macros.length === 0);
  return (
    <>
      <header className={styles.bar} aria-label={words.regions.top}>
        <h1 className={styles.title}>{words.macros.title}</h1>
        <StatusLine onMoveHere={onMoveHere} />
      </header>
      <main className={styles.buttons}>{isEmpty ? <NoButtons /> : <MacroGrid fills />}</main>
      <footer className={styles.foot}>
        <LeaveKiosk />
        <Messages />
      </footer>
    </>
  );
}

const HOLD_MS = 2000;

function LeaveKiosk() {
  const { device, view } = useStores();
  const [isHeld, setHeld] = useState(false);
  const cancel = useRef((): void => undefined);
  useEffect(() => () => cancel.current(), []);

  function hold(): void {
    cancel.current();
    setHeld(true);
    cancel.current = device.clock.after(HOLD_MS, () => view.setState({ kiosk: 'off', tab: 'buttons' }));
  }

  function release(): void {
    cancel.current();
    setHeld(false);
  }

  return (
    <button
      type="button"
      className={styles.leave}
      data-held={isHeld}
      onPointerDown={({ currentTarget, pointerId }) => {
        // A finger would be taken for one on it wherever it goes.
        if (currentTarget.hasPointerCapture(pointerId)) currentTarget.releasePointerCapture(pointerId);
        hold();
      }}
      onPointerUp={release}
      onPointerLeave={release}
      onPointerCancel={release}
      onBlur={release}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={({ key, repeat }) => {
        if ((key === 'Enter' || key === ' ') && !repeat) hold();
      }}
      onKeyUp={release}
    >
      {words.macros.leaveKiosk}
    </button>
  );
}
