// The estimated position as a number, written once a frame past React. Silent to screen readers: it changes all the time,
// and the slider's own value text says what was asked.

import { useRef } from 'react';
import { useStores } from '../stores/stores.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { words } from '../words/en.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo }: { readonly servo: number }) {
  const { device } = useStores();
  const output = useRef<HTMLSpanElement>(null);
  useEachFrame(() => {
    if (output.current === null) return;
    const { estimated } = device.motion(servo);
    const text = estimated === null ? '' : words.servos.estimated(Math.round(estimated));
    if (output.current.textContent !== text) output.current.textContent = text;
  });
  return <span ref={output} className={styles.estimate} aria-hidden="true" />;
}
