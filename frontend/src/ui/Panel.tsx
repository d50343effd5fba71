// A titled area of the instrument: a named section with a header line for its few own controls.

import { useId, type ReactNode } from 'react';
import { cx } from './cx.ts';
import styles from './Panel.module.css';

export interface PanelProps {
  readonly title: string;
  /** Beside the title: what the panel says of itself. */
  readonly note?: ReactNode;
  readonly tools?: ReactNode;
  readonly className?: string | undefined;
  readonly children: ReactNode;
}

export function Panel({ title, note, tools, className, children }: PanelProps) {
  const headingId = useId();
  return (
    <section className={cx(styles.panel, className)} aria-labelledby={headingId}>
      <header className={styles.header}>
        <h2 id={headingId} className={styles.title}>
          {title}
        </h2>
        <div className={styles.note}>{note}</div>
        <div className={styles.tools}>{tools}</div>
      </header>
      {children}
    </section>
  );
}
