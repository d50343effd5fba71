// What is asked of the person now. A step that ends takes its buttons away: the focus goes to the next question instead of nowhere,
// and never straight to what moves the servo.

import { useLayoutEffect, useRef, type ReactNode } from 'react';
import styles from './CalibrationWizard.module.css';

export function Ask({ children }: { readonly children: ReactNode }) {
  const asked = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    if (document.activeElement?.contains(asked.current)) asked.current?.focus();
  }, []);
  return (
    <p ref={asked} className={styles.ask} tabIndex={-1}>
      {children}
    </p>
  );
}
