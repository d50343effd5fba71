import fc from 'fast-check';
import { expect, test } from 'vitest';
import {
  bytesOf,
  createBoardUnderTest,
  download,
  ERASE,
  hexOf,
  move,
  packet,
  READ_BATTERY,
  run,
  STOP,
} from '../testing/board.ts';
import { isProfileName, type ProfileName } from './profileNames.ts';
import { PROFILES } from './profiles.ts';

const NAMES = Object.keys(PROFILES).filter(isProfileName);

const aPacket = fc.oneof(
  fc
    .tuple(fc.nat(400), fc.nat(255), fc.nat(2600))
    .map(([durationMs, servo, position]) => move(durationMs, [servo, position])),
  fc.tuple(fc.constantFrom(0, 1, 8, 100), fc.nat(3)).map(([slot, times]) => run(slot, times)),
  fc.nat(255).map((slot) => download(slot, 1, 0, 100, [1, 600])),
  fc
    .tuple(fc.nat(40), fc.uint8Array({ maxLength: 20 }))
    .map(([command, params]) => packet(command, [...params])),
  fc.uint8Array({ minLength: 1, maxLength: 20 }).map(hexOf),
  fc.constantFrom(STOP, ERASE, READ_BATTERY),
);
const stream = fc.array(aPacket, { maxLength: 30 }).map((parts) => bytesOf(parts.join(' ')));

async function outcome(profile: ProfileName, pieces: readonly Uint8Array[]) {
  const { board, clock, log, takeReplies } = createBoardUnderTest({ profile, baud: 0 });
  for (const piece of pieces) board.receive(piece);
  await clock.advance(777);
  return { replies: takeReplies(), snapshot: board.snapshot(), log };
}

test.each(NAMES)('%s does the same however the bytes are cut into pieces', async (profile) => {
  await fc.assert(
    fc.asyncProperty(stream, fc.integer({ min: 1, max: 40 }), async (bytes, length) => {
      const count = Math.ceil(bytes.length / length);
      const pieces = Array.from({ length: count }, (_, index) =>
        bytes.subarray(index * length, (index + 1) * length),
      );
      expect(await outcome(profile, pieces)).toEqual(await outcome(profile, [bytes]));
    }),
    { numRuns: 30 },
  );
});

test.each(NAMES)('no bytes and no reset make %s throw or leave the range of its servos', async (profile) => {
  const storm = fc.array(fc.tuple(stream, fc.nat(1000), fc.nat(9)), { maxLength: 8 });
  await fc.assert(
    fc.asyncProperty(storm, async (gusts) => {
      const { board, clock } = createBoardUnderTest({ profile });
      for (const [bytes, waitMs, chance] of gusts) {
        board.receive(bytes);
        await clock.advance(waitMs);
        if (chance === 0) board.reboot(waitMs);
        for (const pulse of board.snapshot().pulses) {
          expect(pulse).toBeGreaterThanOrEqual(0);
          expect(pulse).toBeLessThanOrEqual(2500);
        }
      }
    }),
    { numRuns: 30 },
  );
});

test.each(NAMES)('%s has as many servos as it says and refuses more than it can have', (profile) => {
  const { board } = createBoardUnderTest({ profile });
  const { usualServoCount, maxServoCount } = PROFILES[profile];
  expect(board.snapshot().pulses).toHaveLength(usualServoCount);
  expect(() => createBoardUnderTest({ profile, servoCount: maxServoCount + 1 })).toThrow(RangeError);
});
