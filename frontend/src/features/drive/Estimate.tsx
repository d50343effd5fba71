// The estimated position as a number; the slider's own value text says what was asked.

import { motionInFrame } from '../picture/motionInFrame.ts';
import { MovingLabel } from '../picture/MovingText.tsx';
import { useStores } from '../stores.ts';
import { words } from '../../i18n/words.ts';
import type { Scale } from './scale.ts';
import styles from './Estimate.module.css';

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const text = (): string => {
    const { estimated } = motionInFrame(device, servo);
    return estimated === null ? '' : words.servoPanel.estimated({ position: scale.digits(estimated) });
  };
  return (
    <MovingLabel text={text} colour="estimated" className={styles.estimate} title={words.truth.estimated} />
  );
}
