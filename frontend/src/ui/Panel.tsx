// A titled area of the instrument: a named section with a header line for its few own controls.

import { useId, type ReactNode } from 'react';
import { cx } from './cx.ts';
import { PART } from './useParts.ts';
import styles from './Panel.module.css';

export interface PanelProps {
  readonly title: string;
  /** In the title's place for the eye: a choice of which the title is one. */
  readonly tabs?: ReactNode;
  /** Beside the title: what the panel says of itself. */
  readonly note?: ReactNode;
  readonly tools?: ReactNode;
  readonly className?: string | undefined;
  readonly children: ReactNode;
}

export function Panel({ title, tabs, note, tools, className, children }: PanelProps) {
  const headingId = useId();
  return (
    <section {...PART} className={cx(styles.panel, className)} aria-labelledby={headingId}>
      <header className={styles.header}>
        <h2 id={headingId} className={tabs === undefined ? styles.title : styles.unseen}>
          {title}
        </h2>
        {tabs}
        <div className={styles.note}>{note}</div>
        <div className={styles.tools}>{tools}</div>
      </header>
      {children}
    </section>
  );
}
