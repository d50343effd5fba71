// A progress bar for a known amount of work.

import styles from './ProgressBar.module.css';

export interface ProgressBarProps {
  readonly label: string;
  readonly done: number;
  readonly total: number;
  /** The progress in words. */
  readonly text: string;
}

export function ProgressBar({ label, done, total, text }: ProgressBarProps) {
  return (
    <div
      className={styles.bar}
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={total}
      aria-valuenow={done}
      aria-valuetext={text}
    >
      <div className={styles.filled} style={{ transform: `scaleX(${done / total})` }} />
    </div>
  );
}
