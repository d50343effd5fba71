// What a session makes of a robot that others on its link moved before it came: their servos are known, and nothing is
// believed for longer than the link could see the board.

import { expect, test } from 'vitest';
import type { MotionBefore } from '../motion/before.ts';
import { family as familyOf, type BoardId } from '../codec/families.ts';
import { commandIn } from '../codec/parse.ts';
import { createSimulatedTransport } from '../testing/simulatedTransport.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import type { SharedBoard } from './identity.ts';
import { LinkError } from './linkError.ts';
import { createSession } from './robot.ts';
import { FIRST_MOVE_MS } from './timings.ts';
import type { Transport, TransportEvents } from './transport.ts';

const BEFORE: MotionBefore = {
  ways: [{ servo: 1, from: 1_000, to: 2_000, begunMsAgo: 60_000, durationMs: 500 }],
  runSlot: null,
  released: [],
};

function wordOn(board: BoardId): SharedBoard {
  const identity = { evidence: [], candidates: [] };
  const error = new LinkError('boardUnknown', 'nobody has said which board this is');
  return board === 'unknown'
    ? { board, identity, status: 'refused', error }
    : { board, identity, status: 'ready', error: null };
}

async function joined(before: MotionBefore, knownBoard: BoardId = 'doc') {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { onForMs: 60_000 });
  const durations: number[] = [];
  let toTell: MotionBefore | null = before;
  let identified: TransportEvents['identified'];
  const transport: Transport = {
    ...line,
    setBoard(next) {
      identified?.(wordOn(next));
      return Promise.resolve();
    },
    open(events) {
      ({ identified } = events);
      identified?.(wordOn(knownBoard));
      if (toTell !== null) events.placed?.(toTell);
      toTell = null;
      return line.open(events);
    },
    send(packet) {
      const command = commandIn(packet);
      if (command?.kind === 'move') durations.push(command.durationMs);
      return line.send(packet);
    },
  };
  const session = createSession({ transport, clock });
  const whenReady: (number | null)[] = [];
  session.subscribe({
    state: ({ link }) => link.status === 'ready' && whenReady.push(session.motions()(1).estimated),
  });
  await session.open();
  return { clock, line, session, durations, whenReady };
}

test('a servo that others moved is known as soon as it is ready, and its first move from here is not slow', async () => {
  const { clock, session, durations, whenReady } = await joined(BEFORE);
  expect(whenReady[0]).toBe(2_000);
  expect(session.motions()(1)).toEqual({ target: 2_000, estimated: 2_000 });
  session.move([{ servo: 1, position: 1_900 }], 100);
  await clock.advance(1_000);
  session.move([{ servo: 2, position: 1_900 }], 100);
  await clock.advance(1_000);
  expect(durations).toEqual([100, FIRST_MOVE_MS]);
});

test('while a group of others may run nothing may begin that needs a robot at rest', async () => {
  const { session } = await joined({ ...BEFORE, ways: [], runSlot: 4 });
  await expect(
    session.download([{ slot: 3, frames: [{ durationMs: 100, targets: [] }] }]),
  ).rejects.toMatchObject({
    code: 'busy',
  });
});

test('where the link was lost since then nothing of it is known', async () => {
  const { clock, line, session } = await joined(BEFORE);
  line.unplug();
  await clock.advance(100);
  line.plugIn();
  await clock.advance(10_000);
  expect(session.state.link.status).toBe('ready');
  expect(session.motions()(1)).toEqual({ target: null, estimated: null });
});

test('nothing of it is believed of a board that has to be asked first which one it is', async () => {
  const { clock, session } = await joined(BEFORE, 'unknown');
  await clock.advance(10_000);
  expect(session.state.link).toMatchObject({ status: 'refused', error: { code: 'boardUnknown' } });
  await session.choose(familyOf('doc'));
  expect(session.state.link.status).toBe('ready');
  expect(session.motions()(1)).toEqual({ target: null, estimated: null });
});
