// What stands where there is nothing yet: what would be there, and how to begin.

import type { ReactNode } from 'react';
import { cx } from './cx.ts';
import styles from './EmptyState.module.css';

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
      <p className={styles.title}>{title}</p>
      <p>{hint}</p>
      {action}
    </div>
  );
}
