// In place of a control whose command this board lacks: what is absent, and what to do without it.

import styles from './BoardPanel.module.css';

export interface AbsentProps {
  readonly what: string;
  readonly why: string;
}

export function Absent({ what, why }: AbsentProps) {
  return (
    <div className={styles.row}>
      <span className={styles.label}>{what}</span>
      <p className={styles.absent}>{why}</p>
    </div>
  );
}
