// A titled area of the page with a header line for its controls, and the content of an area that is still empty.

import { useId, type ComponentType, type ReactNode } from 'react';
import { cx } from './cx.ts';
import { PART } from './focus.ts';
import styles from './Panel.module.css';

interface PanelProps {
  readonly title: string;
  /** Shown in place of the title: a choice that includes it. A part of its own for F6. */
  readonly tabs?: ReactNode;
  /** A note beside the title. */
  readonly note?: ReactNode;
  readonly tools?: ReactNode;
  readonly className?: string | undefined;
  readonly children: ReactNode;
}

/** The content of a panel that is shown in a shared place. */
export interface PanelParts {
  title(): string;
  readonly Note?: ComponentType;
  readonly Tools: ComponentType;
  readonly Content: ComponentType;
  readonly className: string | undefined;
}

export function Panel({ title, tabs, note, tools, className, children }: PanelProps) {
  const headingId = useId();
  return (
    <section {...PART} className={cx(styles.panel, className)} aria-labelledby={headingId}>
      <header className={styles.header}>
        <h2 id={headingId} className={tabs === undefined ? styles.title : styles.unseen}>
          {title}
        </h2>
        {tabs !== undefined && (
          <div {...PART} className={styles.tabs}>
            {tabs}
          </div>
        )}
        <div className={styles.note}>{note}</div>
        <div className={styles.tools}>{tools}</div>
      </header>
      {children}
    </section>
  );
}

export interface EmptyStateProps {
  readonly title: string;
  readonly hint: string;
  /** Over the words. */
  readonly sketch?: ReactNode;
  /** The way to begin, where it does not stand beside. */
  readonly action?: ReactNode;
  readonly className?: string | undefined;
}

export function EmptyState({ title, hint, sketch, action, className }: EmptyStateProps) {
  return (
    <div className={cx(styles.empty, className)}>
      {sketch}
      <p className={styles.emptyStateTitle}>{title}</p>
      <p>{hint}</p>
      {action}
    </div>
  );
}
