// How busy the wire is: packets sent in the last second, and servos whose newest target still waits for it. For the eye only.

import { useStores } from '../stores/stores.ts';
import { LiveText } from '../ui/LiveText.tsx';
import { words } from '../words/words.ts';
import { sentSince } from './sentSince.ts';
import styles from './MoveTimeControl.module.css';

const WINDOW_MS = 1000;

export function SendRate() {
  const { device } = useStores();
  return (
    <LiveText
      isSilent
      text={() =>
        words.servoPanel.sending(sentSince(device.traffic, device.clock.now() - WINDOW_MS), device.waiting())
      }
      eachMs={WINDOW_MS}
      className={styles.rate}
      title={words.servoPanel.sendingHint}
    />
  );
}
