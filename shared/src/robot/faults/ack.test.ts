// F5 of safety.md section 5: acknowledgements lost, late, doubled, and foreign ones in between, in every order. The oracle
// is the board: what it stored, and what it was working on when the next frame came.

import { expect, test } from 'vitest';
import type { Clock } from '../../clock.ts';
import type { Frame } from '../../codec/commands.ts';
import { family } from '../../codec/families.ts';
import { createRandom } from '../../simulator/faults.ts';
import { createSimulatedChannel } from '../../simulator/channel.ts';
import { createVirtualClock } from '../../testing/virtualClock.ts';
import { createLocalRobot } from '../localRobot.ts';
import type { ByteChannel } from '../byteChannel.ts';
import { caseOf, named, seeds } from '../../testing/cases.ts';

const FILE = 'ack.test.ts';
const OUTCOMES = ['kept', 'lost', 'late', 'doubled', 'foreign'] as const;
type Outcome = (typeof OUTCOMES)[number];

/** A frame of one servo takes 13.5 ms to leave. A copy that comes later than that looks like its answer. */
const NEXT_PACKET_MS = 13;
const ACK_COMMAND = 0x19;
/** An empty 8: an erase was done. */
const FOREIGN = Uint8Array.of(0x55, 0x55, 0x02, 0x08);

interface Circumstances {
  readonly slot: number;
  readonly frames: readonly Frame[];
  readonly lateMs: number;
  readonly doubledAfterMs: number;
}

/** Later than a middle frame is waited for, so that its repetition is already under way; other times in later rounds. */
function circumstancesOf(round: number): Circumstances {
  const random = createRandom(round);
  const between = (least: number, limit: number): number => least + Math.floor(random() * (limit - least));
  return {
    slot: round === 0 ? 5 : between(0, 256),
    frames: [1_000, 1_100, 1_200].map((position) => ({
      durationMs: round === 0 ? 100 : between(0, 30_000),
      targets: [{ servo: 1 + (round % 6), position: position + between(0, 100) }],
    })),
    lateMs: round === 0 ? 420 : between(1, 3_000),
    doubledAfterMs: round === 0 ? 5 : between(1, NEXT_PACKET_MS),
  };
}

/** Does to each acknowledgement what its outcome says; takes whole packets, so that a outcome strikes one at a time. */
function withLosses(
  channel: ByteChannel,
  clock: Clock,
  { lateMs, doubledAfterMs }: Circumstances,
  nextOutcome: () => Outcome,
): ByteChannel {
  let packet: number[] = [];

  function strike(bytes: Uint8Array): void {
    const outcome = bytes.at(-1) === ACK_COMMAND ? nextOutcome() : 'kept';
    const pass = (): void => struck.events?.received(bytes);
    if (outcome === 'foreign') struck.events?.received(FOREIGN);
    if (outcome === 'late') clock.after(lateMs, pass);
    else if (outcome !== 'lost') pass();
    if (outcome === 'doubled') clock.after(doubledAfterMs, pass);
  }

  const struck: ByteChannel = {
    ...channel,
    open(options) {
      channel.events = struck.events && {
        ...struck.events,
        received(bytes) {
          packet.push(...bytes);
          for (; packet.length >= 4; packet = packet.slice(4)) strike(Uint8Array.from(packet.slice(0, 4)));
        },
      };
      return channel.open(options);
    },
  };
  return struck;
}

/** Gives how many acknowledgements the board sent. */
async function storeUnder(outcomes: readonly Outcome[], circumstances: Circumstances): Promise<number> {
  const { slot, frames } = circumstances;
  const clock = createVirtualClock();
  const simulated = createSimulatedChannel(clock, { onForMs: 60_000 });
  let acks = 0;
  const channel = withLosses(simulated, clock, circumstances, () => outcomes[acks++] ?? 'kept');
  const session = createLocalRobot({ channel, isNew: true, family: family('doc'), clock });
  await session.open();
  let outcome: unknown = 'hangs';
  /** What the board had committed when the session said so, not some time later. */
  let countAtResult = 0;
  session.download([{ slot, frames }]).then(
    () => {
      outcome = 'stored';
      countAtResult = simulated.board.frameCount(slot);
    },
    (error: unknown) => (outcome = error),
  );
  await clock.advance(120_000);
  if (outcome === 'stored') {
    expect(countAtResult).toBe(frames.length);
    expect(frames.map((_, at) => simulated.board.storedFrame(slot, at))).toEqual(frames);
    expect(session.state.brokenSlots).toEqual([]);
  } else {
    expect(outcome).toMatchObject({ code: 'noAnswer' });
    expect(session.state.brokenSlots).toEqual([slot]);
  }
  expect(session.state.activity).toEqual({ kind: 'idle' });
  return acks;
}

const LENGTH = 6;
const ORDERS = OUTCOMES.length ** LENGTH;

/** The number written with the outcomes as its digits, the first one the highest. */
function orderOf(number: number): readonly Outcome[] {
  return Array.from(
    { length: LENGTH },
    (_, at) =>
      OUTCOMES[Math.floor(number / OUTCOMES.length ** (LENGTH - 1 - at)) % OUTCOMES.length] ?? 'kept',
  );
}

test('what counts as stored is stored, in every order of six outcomes', { timeout: 300_000 }, async () => {
  // Most downloads end after fewer acknowledgements: orders that differ only afterwards are the same one.
  let tried = { round: -1, outcomes: [] as readonly Outcome[] };
  for (const seed of seeds(ORDERS)) {
    const { at, round } = caseOf(seed, ORDERS);
    const outcomes = orderOf(at);
    if (tried.round === round && tried.outcomes.every((outcome, index) => outcome === outcomes[index]))
      continue;
    await named(FILE, seed, outcomes.join(', '), async () => {
      const used = await storeUnder(outcomes, circumstancesOf(round));
      tried = { round, outcomes: outcomes.slice(0, used) };
    });
  }
});
