// How busy the wire is: packets sent in the last second, and servos whose newest target still waits for it. For the eye only.

import { useStores } from '../stores.ts';
import { LiveText } from '../../ui/LiveText.tsx';
import { words } from '../../i18n/words.ts';
import { sentSince } from './sentSince.ts';
import styles from './MoveTimeControl.module.css';

const WINDOW_MS = 1000;

export function SendRate() {
  const { device } = useStores();
  return (
    <LiveText
      isSilent
      text={() =>
        words.servoPanel.sending({
          packetsPerSecond: sentSince(device.traffic, device.clock.now() - WINDOW_MS),
          waiting: device.waiting(),
        })
      }
      eachMs={WINDOW_MS}
      className={styles.rate}
      title={words.servoPanel.sendingHint}
    />
  );
}
