// What keeps the open firmware's one loop busy without an answer: asking a hand-held pad's receiver (S52) and handing entries on
// to bus servos (S31). Ticks and packets wait meanwhile.

import { describe, expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  move,
  READ_BATTERY,
  run,
  STOP,
  type BoardUnderTest,
} from '../testing/board.ts';
import type { BoardOptions } from './board.ts';

/** Packets are there at once, so that only the loop takes time. */
const AT_ONCE = { baud: 0 } as const;
const STEP_MS = 0.2;
const PHASE_MS = 0.4;
const TICK_MS = 20;

/** When the pulse of that servo changes, each to `STEP_MS`. */
async function changes(under: BoardUnderTest, servo: number, forMs: number): Promise<number[]> {
  const { clock, board } = under;
  const times: number[] = [];
  const endMs = clock.now() + forMs;
  for (let before = board.pulse(servo); clock.now() < endMs; before = board.pulse(servo)) {
    await clock.advance(STEP_MS);
    if (board.pulse(servo) !== before) times.push(clock.now());
  }
  return times;
}

const range = (to: number, step: number): number[] =>
  Array.from({ length: Math.round(to / step) }, (_, index) => index * step);

interface Polling {
  readonly options: Partial<BoardOptions>;
  readonly pollMs: number;
}

const POLLING: Readonly<Record<string, Polling>> = {
  'the old build': { options: { profile: 'openarm-old' }, pollMs: 5.2 },
  'the new build with a pad': { options: { profile: 'openarm-new', hasPad: true }, pollMs: 6.4 },
  'the new build without one': { options: { profile: 'openarm-new' }, pollMs: 0 },
};
const CASES = Object.entries(POLLING);
const BETWEEN_MS = 50;

describe('S52: a poll of the pad', () => {
  test.each(CASES)('%s: a stop behind another packet is lost just while it lasts', async (_, polling) => {
    const apartMs = 0.5;
    const periodMs = BETWEEN_MS + polling.pollMs;
    let lost = 0;
    for (const phaseMs of range(periodMs, PHASE_MS)) {
      const { board, clock, exchange, send } = createBoardUnderTest({ ...AT_ONCE, ...polling.options });
      await exchange(download(1, 1, 0, 30_000, [1, 1000]), 1000);
      await exchange(run(1, 1), 100 + phaseMs);
      send(READ_BATTERY);
      await clock.advance(apartMs);
      await exchange(STOP);
      if (board.runningSlot() === 1) lost += 1;
    }
    expect(lost * PHASE_MS).toBeCloseTo(Math.max(0, polling.pollMs - apartMs), 0);
  });

  test.each(CASES)('%s: one stop alone waits for its end and is heard', async (_, polling) => {
    for (const phaseMs of range(BETWEEN_MS + polling.pollMs, 1)) {
      const { board, exchange } = createBoardUnderTest({ ...AT_ONCE, ...polling.options });
      await exchange(download(1, 1, 0, 30_000, [1, 1000]), 1000);
      await exchange(run(1, 1), 100 + phaseMs);
      await exchange(STOP, polling.pollMs + STEP_MS);
      expect(board.runningSlot()).toBeNull();
    }
  });

  test.each(CASES)(
    '%s: a tick waits for its end, and the next ones are on time again',
    async (_, polling) => {
      const under = createBoardUnderTest({ ...AT_ONCE, ...polling.options });
      await under.exchange(move(20_000, [1, 2500]), 1000);
      const beginsMs = under.clock.now();
      const times = await changes(under, 1, 2000);
      const late = times.map((time) => (time - beginsMs) % TICK_MS).map((ms) => (ms > TICK_MS - 1 ? 0 : ms));
      expect(times).toHaveLength(2000 / TICK_MS);
      expect(Math.max(...late)).toBeLessThanOrEqual(polling.pollMs + 2 * STEP_MS);
      expect(Math.max(...late)).toBeGreaterThanOrEqual(polling.pollMs * 0.8);
      const share = late.filter((ms) => ms > 2 * STEP_MS).length / late.length;
      expect(share).toBeCloseTo(polling.pollMs / (BETWEEN_MS + polling.pollMs), 1);
    },
  );
});

describe('S31: entries handed on to bus servos', () => {
  const ENTRY_MS = 0.87;
  const SENT_AT_MS = 3;
  /** Nothing of it is accepted: servo 9 has no channel, 3000 is out of range (S23, S24). Unfiltered, each goes out. */
  const refused = (count: number): string =>
    move(1000, ...range(count, 1).map((index): [number, number] => (index % 2 ? [9, 1500] : [2, 3000])));

  /** Servo 1 is under way, that packet comes 3 ms behind a tick: when it moves on, and where it is 100 ms later. */
  async function movesOn(options: Partial<BoardOptions>, hex: string) {
    const under = createBoardUnderTest({ ...AT_ONCE, ...options });
    await under.exchange(move(20_000, [1, 2500]), 1000 + SENT_AT_MS);
    under.send(hex);
    const [firstMs = NaN] = await changes(under, 1, 100);
    return { afterMs: firstMs - 1000, pulse: under.board.pulse(1) };
  }

  test('each keeps the loop busy for 0.87 ms, also one that no servo takes; the ticks are made up for', async () => {
    for (const count of [1, 19, 21, 40, 80]) {
      const { afterMs, pulse } = await movesOn({ profile: 'openarm-new' }, refused(count));
      expect(afterMs - Math.max(TICK_MS, SENT_AT_MS + count * ENTRY_MS)).toBeCloseTo(0, 0);
      expect(pulse).toBe((await movesOn({ profile: 'doc' }, READ_BATTERY)).pulse);
    }
  });

  test('a board that hands on nothing is on time', async () => {
    expect((await movesOn({ profile: 'doc' }, refused(80))).afterMs).toBeCloseTo(TICK_MS, 0);
  });

  test('a third packet meanwhile is dropped, as behind any work (S9, S10)', async () => {
    for (const [profile, isDropped] of [
      ['openarm-new', true],
      ['doc', false],
    ] as const) {
      const { clock, exchange, send, pulses } = createBoardUnderTest({ ...AT_ONCE, profile });
      await exchange(move(20, [1, 1000]), 1000);
      send(refused(80));
      await clock.advance(1);
      send(READ_BATTERY);
      await clock.advance(1);
      await exchange(move(20, [1, 2000]), 200);
      expect(pulses(1)).toEqual([isDropped ? 1000 : 2000]);
    }
  });

  test('a pad that is due meanwhile is asked right behind them', async () => {
    const count = 80;
    const workedMs = SENT_AT_MS + count * ENTRY_MS;
    const { afterMs } = await movesOn({ profile: 'openarm-new', hasPad: true }, refused(count));
    expect(afterMs - workedMs).toBeCloseTo(6.4, 0);
  });

  const targets = (position: number) => range(6, 1).map((index): [number, number] => [index + 1, position]);
  const FRAMES = [1000, 2000, 1000].map((position, index) =>
    download(1, 3, index, 500, ...targets(position)),
  );

  test('those of a stored frame, too: a stop behind another packet is lost meanwhile', async () => {
    for (const [profile, runningSlot] of [
      ['openarm-new', 1],
      ['doc', null],
    ] as const) {
      const { board, clock, exchange, send } = createBoardUnderTest({ ...AT_ONCE, profile });
      for (const frame of FRAMES) await exchange(frame, 1000);
      await exchange(run(1, 1), 501);
      send(READ_BATTERY);
      await clock.advance(1);
      await exchange(STOP);
      expect(board.runningSlot()).toBe(runningSlot);
    }
  });

  test('those of a stored frame do not delay the next one (S42)', async () => {
    for (const profile of ['openarm-new', 'doc'] as const) {
      const under = createBoardUnderTest({ ...AT_ONCE, profile });
      for (const frame of FRAMES) await under.exchange(frame, 1000);
      under.send(run(1, 1));
      const begunMs = under.clock.now();
      const times = await changes(under, 6, 1700);
      const [first = NaN, last = NaN] = [times[0], times.at(-1)];
      expect([times.length, Math.round(first - begunMs), Math.round(last - begunMs)]).toEqual([75, 20, 1500]);
    }
  });
});
