// The estimated position as a number, written past React and no more often than it can be read. Silent to screen readers:
// it changes all the time, and the slider's own value text says what was asked.

import { useRef } from 'react';
import { motionInFrame } from '../body/motionInFrame.ts';
import { useStores } from '../stores/stores.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { words } from '../words/words.ts';
import type { Scale } from './scale.ts';
import styles from './Estimate.module.css';

const WRITE_EACH_MS = 100;

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const output = useRef<HTMLSpanElement>(null);
  const written = useRef({ text: '', atMs: -Infinity });
  useEachFrame(() => {
    const atMs = device.clock.now();
    if (output.current === null || atMs - written.current.atMs < WRITE_EACH_MS) return;
    const { estimated } = motionInFrame(device, servo);
    const text = estimated === null ? '' : words.servoPanel.estimated(scale.digits(estimated));
    if (text !== written.current.text) output.current.textContent = text;
    written.current = { text, atMs };
  });
  return <span ref={output} className={styles.estimate} aria-hidden="true" />;
}
