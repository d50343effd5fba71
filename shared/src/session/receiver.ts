// From bytes to reports: feeds the decoder and tells it when the line fell silent. Knows the family's meaning of a
// packet; not who waits for it.

import type { Clock } from '../clock.ts';
import { createDecoder } from '../protocol/decoder.ts';
import type { Family } from '../protocol/families.ts';
import { parseReport } from '../protocol/parse.ts';
import type { Report } from '../protocol/reports.ts';
import { LINE_IDLE_MS } from './timings.ts';

export interface ReceiverOptions {
  readonly clock: Clock;
  readonly family: Family;
  report(report: Report, bytes: Uint8Array): void;
  noise(reason: 'garbage' | 'truncated', bytes: Uint8Array): void;
}

export interface Receiver {
  push(bytes: Uint8Array): void;
  /** Forgets a half packet: a new connection starts clean. */
  reset(): void;
}

export function createReceiver({ clock, family, report, noise }: ReceiverOptions): Receiver {
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') report(parseReport(event.packet, family), event.bytes);
    else noise(event.reason, event.bytes);
  });
  let cancelIdle = (): void => undefined;

  return {
    push(bytes) {
      cancelIdle();
      decoder.push(bytes);
      cancelIdle = clock.after(LINE_IDLE_MS, () => decoder.idle());
    },
    reset() {
      cancelIdle();
      decoder.reset();
    },
  };
}
