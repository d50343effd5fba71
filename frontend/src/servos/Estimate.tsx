// The estimated position as a number, no more often than it can be read. Silent to screen readers: it changes all the time,
// and the slider's own value text says what was asked.

import { motionInFrame } from '../body/motionInFrame.ts';
import { useStores } from '../stores/stores.ts';
import { LiveText } from '../ui/LiveText.tsx';
import { READABLE_MS } from '../ui/useFollow.ts';
import { words } from '../words/words.ts';
import type { Scale } from './scale.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const text = (): string => {
    const { estimated } = motionInFrame(device, servo);
    return estimated === null ? '' : words.servoPanel.estimated(scale.digits(estimated));
  };
  return (
    <LiveText
      isSilent
      isFixed
      text={text}
      eachMs={READABLE_MS}
      className={styles.estimate}
      title={words.truth.estimated}
    />
  );
}
