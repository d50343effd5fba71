// F5 of safety.md section 5: acknowledgements lost, late, doubled, and foreign ones in between, in every order. The oracle
// is the board: what it stored, and what it was working on when the next frame came.

import { expect, test } from 'vitest';
import type { Clock } from '../../clock.ts';
import type { Frame } from '../../protocol/commands.ts';
import { family } from '../../protocol/families.ts';
import { createSimulatedTransport } from '../../simulator/transport.ts';
import { createVirtualClock } from '../../simulator/virtualClock.ts';
import { createSession } from '../session.ts';
import type { Transport } from '../transport.ts';
import { cases, named } from './amount.ts';

const FILE = 'ack.test.ts';
const SLOT = 5;
const FATES = ['kept', 'lost', 'late', 'doubled', 'foreign'] as const;
type Fate = (typeof FATES)[number];

/** Later than a middle frame is waited for, so that its repetition is already under way. */
const LATE_MS = 420;
const DOUBLED_AFTER_MS = 5;
const ACK_COMMAND = 0x19;
/** An empty 8: somebody's erase was done. */
const FOREIGN = Uint8Array.of(0x55, 0x55, 0x02, 0x08);
const FRAMES: readonly Frame[] = [1_000, 1_100, 1_200].map((position) => ({
  durationMs: 100,
  targets: [{ servo: 1, position }],
}));

/** Does to each acknowledgement what its fate says. */
function withFates(transport: Transport, clock: Clock, nextFate: () => Fate): Transport {
  return {
    ...transport,
    open: (events) =>
      transport.open({
        ...events,
        received(bytes) {
          const fate = bytes.at(-1) === ACK_COMMAND ? nextFate() : 'kept';
          const pass = (): void => events.received(bytes);
          if (fate === 'foreign') events.received(FOREIGN);
          if (fate === 'late') clock.after(LATE_MS, pass);
          else if (fate !== 'lost') pass();
          if (fate === 'doubled') clock.after(DOUBLED_AFTER_MS, pass);
        },
      }),
  };
}

/** Whole packets, so that a fate strikes one at a time. */
function gathered(transport: Transport): Transport {
  let packet: number[] = [];
  return {
    ...transport,
    open: (events) =>
      transport.open({
        ...events,
        received(bytes) {
          packet.push(...bytes);
          for (; packet.length >= 4; packet = packet.slice(4))
            events.received(Uint8Array.from(packet.slice(0, 4)));
        },
      }),
  };
}

/** Gives how many acknowledgements the board sent. */
async function storeUnder(fates: readonly Fate[]): Promise<number> {
  const clock = createVirtualClock();
  const simulated = createSimulatedTransport(clock, { onForMs: 60_000 });
  let acks = 0;
  const transport = withFates(gathered(simulated), clock, () => fates[acks++] ?? 'kept');
  const session = createSession({ transport, family: family('doc'), clock });
  await session.open();
  let outcome: unknown = 'hangs';
  /** What the board had committed when the session said so, not some time later. */
  let countWhenTold = 0;
  session.download(SLOT, FRAMES).then(
    () => {
      outcome = 'stored';
      countWhenTold = simulated.board.frameCount(SLOT);
    },
    (error: unknown) => (outcome = error),
  );
  await clock.advance(120_000);
  if (outcome === 'stored') {
    expect(countWhenTold).toBe(FRAMES.length);
    expect(FRAMES.map((_, at) => simulated.board.storedFrame(SLOT, at))).toEqual(FRAMES);
    expect(session.state.brokenSlots).toEqual([]);
  } else {
    expect(outcome).toMatchObject({ code: 'noAnswer' });
    expect(session.state.brokenSlots).toEqual([SLOT]);
  }
  expect(session.state.activity).toEqual({ kind: 'idle' });
  return acks;
}

const LENGTH = 6;

/** The number written with the fates as its digits, the first one the highest. */
function orderOf(number: number): readonly Fate[] {
  return Array.from(
    { length: LENGTH },
    (_, at) => FATES[Math.floor(number / FATES.length ** (LENGTH - 1 - at)) % FATES.length] ?? 'kept',
  );
}

test('what counts as stored is stored, in every order of six fates', { timeout: 60_000 }, async () => {
  // Most downloads end after fewer acknowledgements: orders that differ only afterwards are the same one.
  let tried: readonly Fate[] = [];
  for (const number of cases(FATES.length ** LENGTH)) {
    const fates = orderOf(number);
    if (tried.length > 0 && tried.every((fate, at) => fate === fates[at])) continue;
    await named(FILE, number, fates.join(', '), async () => {
      tried = fates.slice(0, await storeUnder(fates));
    });
  }
});
