// What each way to a robot looks like: the plug, the module or the computer that a person has in front of them.

import type { Way } from '../../robot/device.ts';
import styles from './ConnectWays.module.css';

const USB_PLUG = 'M4 18h14v12H4zM18 14h12v20H18zM8 22h3M8 26h3';

const SHAPES: Readonly<Record<Way['kind'], string>> = {
  // An adapter with a USB plug at one end and the four pins of the header at the other.
  webSerial: `${USB_PLUG}M30 18h10M30 22h10M30 26h10M30 30h10`,
  // The plug of the cable in the box, and the board that it goes into.
  webHid: `${USB_PLUG}M30 24h4M34 12h10v24H34zM38 17h2M38 22h2M38 27h2M38 32h2`,
  // A module on its header, and its antenna.
  webBluetooth:
    'M8 16h18v20H8zM12 36v6M17 36v6M22 36v6M13 21l8 8-4 4V19l4 4-8 8M31 20a8 8 0 0 1 0 12M36 15a15 15 0 0 1 0 22',
  // A computer, its cable and a board.
  gateway: 'M4 10h24v18H4zM10 34h12M16 28v6M28 20h6v6M30 26h14v14H30zM35 31h4v4h-4z',
  // A robot on a screen.
  simulated: 'M4 9h40v26H4zM16 41h16M24 35v6M14 30h10M19 30l-2-9 9-6 6 5M30 22l2-2 2 2',
};

export function CablePicture({ kind }: { readonly kind: Way['kind'] }) {
  return (
    <svg className={styles.picture} viewBox="0 0 48 48" width="48" height="48" aria-hidden="true">
      <path d={SHAPES[kind]} fill="none" stroke="currentColor" strokeWidth="1.5" strokeLinejoin="round" />
    </svg>
  );
}
