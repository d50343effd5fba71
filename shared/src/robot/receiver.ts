// From bytes to reports: feeds the decoder and tells it when the line is silent. Knows the family's meaning of a
// packet; not who waits for it.

import type { Clock } from '../clock.ts';
import { createDecoder } from '../codec/decoder.ts';
import type { Family } from '../codec/families.ts';
import { parseReport } from '../codec/parse.ts';
import type { Report } from '../codec/reports.ts';
import { LINE_IDLE_MS, LINE_PAUSE_MS } from './timings.ts';

export interface ReceiverOptions {
  readonly clock: Clock;
  /** What the board is taken for at this moment. */
  family(): Family;
  report(report: Report, bytes: Uint8Array): void;
  noise(reason: 'garbage' | 'truncated', bytes: Uint8Array): void;
}

export interface Receiver {
  /** `whole`: these bytes are whole packets, nothing that could belong to them will follow. */
  push(bytes: Uint8Array, whole: boolean): void;
  /** Forgets a half packet: a new connection starts clean. */
  reset(): void;
}

export function createReceiver({ clock, family, report, noise }: ReceiverOptions): Receiver {
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') report(parseReport(event.packet, family()), event.bytes);
    else noise(event.reason, event.bytes);
  });
  let cancelTimers: readonly (() => void)[] = [];

  function silenceBroken(): void {
    for (const cancel of cancelTimers) cancel();
  }

  return {
    push(bytes, whole) {
      silenceBroken();
      decoder.push(bytes);
      if (whole) decoder.pause();
      cancelTimers = [
        clock.after(LINE_PAUSE_MS, () => decoder.pause()),
        clock.after(LINE_IDLE_MS, () => decoder.idle()),
      ];
    },
    reset() {
      silenceBroken();
      decoder.reset();
    },
  };
}
