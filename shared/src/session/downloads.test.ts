// A download against shared/protocol/vectors/downloads.json: when a board says what, and each packet that follows from it.
// The gateway's own loop (backend/servodeck/board/download.py) runs the same file.

import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { sleep } from '../clock.ts';
import type { Frame } from '../protocol/commands.ts';
import { family as familyOf, type FamilyId } from '../protocol/families.ts';
import { fromHex, toHex } from '../protocol/hex.ts';
import { wireMs } from '../protocol/packet.ts';
import { createVirtualClock } from '../simulator/virtualClock.ts';
import { LinkError } from './linkError.ts';
import { createSession } from './session.ts';
import type { Transport, TransportEvents } from './transport.ts';

interface VectorFrame {
  readonly durationMs: number;
  readonly targets: readonly (readonly [servo: number, position: number])[];
}

interface Scenario {
  readonly name: string;
  readonly family: FamilyId;
  readonly slot: number;
  readonly frames: readonly VectorFrame[];
  /** Groups behind the first one. */
  readonly then?: readonly { readonly slot: number; readonly frames: readonly VectorFrame[] }[];
  /** For each packet that is sent, when the board says "stored": after the packet's last bit. */
  readonly answersMs: readonly (readonly number[])[];
  readonly cancelAtMs?: number;
  readonly packets: readonly string[];
  /** Begin of each packet, and its place in `packets`. */
  readonly sent: readonly (readonly [atMs: number, frameIndex: number])[];
  readonly outcome: string;
  /** Where it is not the slot of the first group. */
  readonly broken?: readonly number[];
  readonly tookMs: number;
}

interface Vectors {
  readonly scenarios: readonly Scenario[];
}

const FILE = new URL('../../protocol/vectors/downloads.json', import.meta.url);
const vectors = JSON.parse(readFileSync(FILE, 'utf8')) as Vectors;
const STORED = fromHex('55550219');
const GIVEN_UP_MS = 60_000;
const exactly = (ms: number): number => Math.round(ms * 1000) / 1000;

async function play({ family, slot, frames, then = [], answersMs, cancelAtMs }: Scenario) {
  const clock = createVirtualClock();
  const sent: { atMs: number; packet: string }[] = [];
  let events: TransportEvents | null = null;
  const transport: Transport = {
    ...{ kind: 'webSerial', label: 'Board', isSimulated: true },
    open(next) {
      events = next;
      return Promise.resolve();
    },
    async send(packet) {
      sent.push({ atMs: exactly(clock.now()), packet: toHex(packet).replaceAll(' ', '').toLowerCase() });
      const answers = answersMs[sent.length - 1] ?? [];
      const leftAfterMs = wireMs(packet.length);
      for (const afterMs of answers) clock.after(leftAfterMs + afterMs, () => events?.received(STORED));
      await sleep(clock, leftAfterMs);
    },
    close: () => Promise.resolve(),
  };
  const session = createSession({ transport, clock, family: familyOf(family) });
  await session.open();
  if (cancelAtMs !== undefined) clock.after(cancelAtMs, () => void session.cancelDownload());
  const groups = [{ slot, frames }, ...then].map((one) => ({ ...one, frames: one.frames.map(frameOf) }));
  const ended = session.download(groups).then(
    () => ({ outcome: 'done', tookMs: clock.now() }),
    (error: unknown) => ({ outcome: error instanceof LinkError ? error.code : '', tookMs: clock.now() }),
  );
  await clock.advance(GIVEN_UP_MS);
  const { outcome, tookMs } = await ended;
  return { sent, outcome, tookMs: exactly(tookMs), broken: session.state.brokenSlots };
}

function frameOf({ durationMs, targets }: VectorFrame): Frame {
  return { durationMs, targets: targets.map(([servo, position]) => ({ servo, position })) };
}

describe('a download in which', () => {
  test.each(vectors.scenarios)('$name', async (scenario) => {
    const { packets, sent, outcome, tookMs, slot, broken = [slot] } = scenario;
    expect(await play(scenario)).toEqual({
      sent: sent.map(([atMs, frameIndex]) => ({ atMs, packet: packets[frameIndex] })),
      outcome,
      tookMs,
      broken: outcome === 'done' ? [] : broken,
    });
  });
});
