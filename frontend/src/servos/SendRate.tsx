// How busy the wire is: packets sent in the last second, and servos whose newest target still waits for it. For the eye only.

import { useRef } from 'react';
import { useStores } from '../stores/stores.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { words } from '../words/words.ts';
import { sentSince } from './sentSince.ts';
import styles from './MoveTimeControl.module.css';

const WINDOW_MS = 1000;
/** Fast enough to follow, slow enough to read. */
const WRITE_EACH_MS = 250;

export function SendRate() {
  const { device } = useStores();
  const output = useRef<HTMLSpanElement>(null);
  const writtenMs = useRef(-Infinity);
  useEachFrame(() => {
    const nowMs = device.clock.now();
    if (output.current === null || nowMs - writtenMs.current < WRITE_EACH_MS) return;
    writtenMs.current = nowMs;
    output.current.textContent = words.servoPanel.sending(
      sentSince(device.traffic, nowMs - WINDOW_MS),
      device.waiting(),
    );
  });
  return (
    <span ref={output} className={styles.rate} title={words.servoPanel.sendingHint} aria-hidden="true" />
  );
}
