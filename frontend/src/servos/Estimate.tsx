// The estimated position as a number. Silent to screen readers: it changes all the time, and the slider's own value text says what
// was asked.

import { useRef } from 'react';
import { motionInFrame } from '../body/motionInFrame.ts';
import { MovingText } from '../body/MovingText.tsx';
import { useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import type { Scale } from './scale.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const place = useRef<HTMLSpanElement>(null);
  const text = (): string => {
    const { estimated } = motionInFrame(device, servo);
    return estimated === null ? '' : words.servoPanel.estimated(scale.digits(estimated));
  };
  const write = (now: string): void => {
    if (place.current !== null) place.current.textContent = now;
  };
  const cover = (isCovered: boolean): void => {
    if (place.current !== null) place.current.style.opacity = isCovered ? '0' : '';
  };
  return (
    <span className={styles.estimate} title={words.truth.estimated} aria-hidden="true">
      <span ref={place} className={styles.text} />
      <MovingText element={place} {...{ text, write, cover }} colour="estimated" />
    </span>
  );
}
