import { expect, test } from 'vitest';
import {
  createBoardUnderTest,
  download,
  DOWNLOAD_ACK,
  ERASE,
  ERASE_ACK,
  GROUP_ENDED,
  READ_BATTERY,
  run,
  RUN_ACK,
  STOP,
} from '../testing/board.ts';
import type { ProfileName } from './profileNames.ts';

/** A board of that build whose group 100 and its successor take 200 ms each. */
async function boardWithChain(profile: ProfileName) {
  const under = createBoardUnderTest({ profile });
  await under.exchange(download(100, 1, 0, 200, [1, 1000]), 400);
  await under.exchange(download(101, 1, 0, 200, [1, 2000]), 400);
  expect(under.takeReplies()).toBe(`${DOWNLOAD_ACK} ${DOWNLOAD_ACK}`);
  return under;
}

test('S18, S48: the old build says nothing of a run, neither at its start nor at its end', async () => {
  const { board, exchange, takeReplies } = await boardWithChain('openarm-old');
  await exchange(run(100, 1));
  expect(board.runningSlot()).toBe(100);
  await exchange(run(9, 1), 1000);
  expect(board.runningSlot()).toBeNull();
  expect(takeReplies()).toBe('');
});

test('S49: the old build does not go on to group 101', async () => {
  const { exchange, pulses } = await boardWithChain('openarm-old');
  await exchange(run(100, 1), 1000);
  expect(pulses(1)).toEqual([1000]);
});

test('S18, S48, S49: the new build acknowledges the run, goes on from 100 to 101 and says each end', async () => {
  const { exchange, pulses, takeReplies } = await boardWithChain('openarm-new');
  await exchange(run(100, 1), 1000);
  expect(pulses(1)).toEqual([2000]);
  expect(takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED} ${GROUP_ENDED}`);
});

test.each(['openarm-old', 'openarm-new'] as const)(
  'S17: %s never answers the battery query',
  async (profile) => {
    const { exchange, takeReplies } = createBoardUnderTest({ profile });
    await exchange(READ_BATTERY, 1000);
    expect(takeReplies()).toBe('');
  },
);

test.each(['openarm-old', 'openarm-new'] as const)(
  'S19, S50: %s answers an erase, not a stop',
  async (profile) => {
    const { exchange, takeReplies } = createBoardUnderTest({ profile });
    await exchange(STOP);
    expect(takeReplies()).toBe('');
    await exchange(ERASE);
    expect(takeReplies()).toBe(ERASE_ACK);
  },
);

test('S17: the ideal board is the new build with a battery answer', async () => {
  const { exchange, pulses, takeReplies } = await boardWithChain('doc');
  await exchange(run(100, 1), 1000);
  expect(pulses(1)).toEqual([2000]);
  await exchange(READ_BATTERY);
  expect(takeReplies()).toBe(`${RUN_ACK} ${GROUP_ENDED} ${GROUP_ENDED} 55 55 04 0F 4C 1D`);
});

test('a board of six servos is not made with more', () => {
  expect(() => createBoardUnderTest({ profile: 'openarm-new', servoCount: 7 })).toThrow(RangeError);
});
