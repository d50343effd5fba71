// A word with the shape and colour of its state. Shape, colour and word each suffice to recognise it.

import { cx } from './cx.ts';
import styles from './Chip.module.css';

export type Truth =
  | 'neutral'
  | 'commanded'
  | 'estimated'
  | 'confirmed'
  | 'unknown'
  | 'guessed'
  | 'warning'
  | 'danger';

export function Mark({ truth }: { readonly truth: Truth }) {
  return (
    <svg className={cx(styles.mark, styles[truth])} viewBox="0 0 12 12" aria-hidden="true" focusable="false">
      {SHAPES[truth]}
    </svg>
  );
}

export function Chip({ truth, children }: { readonly truth: Truth; readonly children: string }) {
  return (
    <span className={styles.chip}>
      <Mark truth={truth} />
      {children}
    </span>
  );
}

const SHAPES: Readonly<Record<Truth, React.ReactNode>> = {
  neutral: <circle cx="6" cy="6" r="3.5" className={styles.outline} />,
  commanded: <path d="M1.5 2.5h9L6 10.5z" className={styles.outline} />,
  estimated: <path d="M4.5 1h3v10h-3z" className={styles.solid} />,
  confirmed: <path d="M1.5 6.5l3 3L10.5 2.5" className={styles.outline} />,
  unknown: <path d="M2 10L10 2M2 6l4-4M6 10l4-4" className={styles.outline} />,
  guessed: <path d="M6 2l4 4-4 4-4-4z" className={styles.outline} />,
  warning: <path d="M6 1l5.5 10H.5z" className={styles.solid} />,
  danger: <path d="M2.5 2.5l7 7M9.5 2.5l-7 7" className={styles.outline} />,
};
