// Listens on a serial port at other speeds than the boards', one after another, until something that can be read arrives. Writes
// nothing; the port must not be open. Knows bytes and packets, no board.

import { sleep } from '#shared/clock.ts';
import { createDecoder } from '#shared/codec/decoder.ts';
import timings from '../../../../shared/protocol/timings.json' with { type: 'json' };
import { browserClock } from './browserClock.ts';
import { settled } from './connection.ts';

const { otherRates, listenMs } = timings.line;

/** A line that stays disturbed does not keep the page busy. */
const LINE_ERROR_PAUSE_MS = 20;

export interface HeardAtRate {
  readonly baud: number;
  readonly packets: number;
  /** What is no packet. */
  readonly noise: readonly number[];
}

/** null where nothing that `isReadable` arrives by itself. Rejects where the port cannot be opened. */
export async function findRate(
  port: SerialPort,
  isReadable: (heard: HeardAtRate) => boolean,
): Promise<HeardAtRate | null> {
  for (const baud of otherRates) {
    const heard = await listenAt(port, baud);
    if (isReadable(heard)) return heard;
  }
  return null;
}

async function listenAt(port: SerialPort, baud: number): Promise<HeardAtRate> {
  let packets = 0;
  const noise: number[] = [];
  const decoder = createDecoder((event) => {
    if (event.kind === 'packet') packets += 1;
    else noise.push(...event.bytes);
  });
  const untilMs = browserClock.now() + listenMs;
  let reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  await port.open({ baudRate: baud });
  const cancel = browserClock.after(listenMs, () => void settled(reader?.cancel() ?? Promise.resolve()));
  try {
    // At the wrong speed bytes break the line's rules: each such error ends the stream, and the next one is fresh.
    while (browserClock.now() < untilMs && port.readable !== null) {
      reader = port.readable.getReader();
      await settled(readAll(reader, (bytes) => decoder.push(bytes)));
      reader.releaseLock();
      await sleep(browserClock, LINE_ERROR_PAUSE_MS);
    }
  } finally {
    cancel();
    await settled(port.close());
  }
  decoder.idle();
  return { baud, packets, noise };
}

async function readAll(
  reader: ReadableStreamDefaultReader<Uint8Array>,
  received: (bytes: Uint8Array) => void,
): Promise<void> {
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    received(value);
  }
}
