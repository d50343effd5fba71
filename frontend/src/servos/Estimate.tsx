// The estimated position as a number, written once a frame past React. Silent to screen readers: it changes all the time,
// and the slider's own value text says what was asked.

import { useRef } from 'react';
import { useMotion } from '../body/useMotion.ts';
import { words } from '../words/en.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo }: { readonly servo: number }) {
  const output = useRef<HTMLSpanElement>(null);
  useMotion(servo, ({ estimated }) => {
    if (output.current === null) return;
    output.current.textContent = estimated === null ? '' : words.servos.estimated(Math.round(estimated));
  });
  return <span ref={output} className={styles.estimate} aria-hidden="true" />;
}
