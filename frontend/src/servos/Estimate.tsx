// The estimated position as a number, written once a frame past React. Silent to screen readers: it changes all the time,
// and the slider's own value text says what was asked.

import { useEffect, useRef } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import { useMotion } from '../body/useMotion.ts';
import { useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import type { Scale } from './scale.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const output = useRef<HTMLSpanElement>(null);
  const write = ({ estimated }: ServoMotion): void => {
    if (output.current === null) return;
    output.current.textContent =
      estimated === null ? '' : words.servoPanel.estimated(scale.digits(estimated));
  };
  useMotion(servo, write);
  useEffect(() => write(device.motion(servo)));
  return <span ref={output} className={styles.estimate} aria-hidden="true" />;
}
