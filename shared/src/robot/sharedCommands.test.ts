// What a session on a shared link has the board do: the link does it, and the session shows what came of it.

import { expect, test } from 'vitest';
import type { Command } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { family as familyOf } from '../codec/families.ts';
import { fromHex } from '../codec/packet.ts';
import { createSimulatedTransport } from '../testing/simulatedTransport.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { LinkError } from './linkError.ts';
import { createSession } from './robot.ts';
import type { Outcome, SharedCommands, TransportEvents } from './transport.ts';

const RUN = { kind: 'run', slot: 3, times: 2 } as const;

async function shared(outcome: () => Promise<Outcome>) {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { onForMs: 60_000 });
  const asked: unknown[] = [];
  const sent: number[] = [];
  let events: TransportEvents | undefined;
  const note =
    (name: string) =>
    (...values: readonly unknown[]): Promise<Outcome> => {
      asked.push([name, ...values]);
      return outcome();
    };
  const commands: SharedCommands = {
    run: note('run'),
    stopGroup: note('stopGroup'),
    erase: note('erase'),
    setSpeed: note('setSpeed'),
    release: note('release'),
    read: note('read'),
  };
  const session = createSession({
    clock,
    family: familyOf('doc'),
    transport: {
      ...{ ...line, commands },
      open(heard) {
        events = heard;
        return line.open(heard);
      },
      send(packet) {
        sent.push(packet[3] ?? 0);
        return line.send(packet);
      },
    },
  });
  await session.open();
  return { session, asked, sent, left: (command: Command) => events?.left?.(command) };
}

test.each([
  ['acknowledged', 'acknowledged'],
  ['sent', 'requested'],
] as const)('a run that is %s', async (outcome, truth) => {
  const { session, asked, sent } = await shared(() => Promise.resolve(outcome));
  await session.run(3, 2);
  expect(asked).toEqual([['run', 3, 2]]);
  expect(session.state.activity).toMatchObject({ kind: 'running', slot: 3, times: 2, truth });
  await session.run(3, 2);
  await session.stopGroup();
  expect(asked.slice(1)).toEqual([['run', 3, 2], ['stopGroup']]);
  expect(session.state.activity).toEqual({ kind: 'idle' });
  expect(sent).toEqual([]);
});

test.each([
  ['silent', () => Promise.resolve<Outcome>('silent'), 'noAnswer', 'running'],
  [
    'lost',
    () => Promise.reject(new LinkError('gatewayUnreachable', 'gone')),
    'gatewayUnreachable',
    'running',
  ],
  ['refused', () => Promise.reject(new LinkError('latched', 'stopped')), 'latched', 'idle'],
] as const)('a run that is %s', async (_, outcome, code, kind) => {
  const { session } = await shared(outcome);
  await expect(session.run(3, 2)).rejects.toMatchObject({ code });
  expect(session.state.activity.kind).toBe(kind);
  if (kind === 'running') expect(session.state.activity).toMatchObject({ truth: 'unknown' });
});

test('an erase is shown while it lasts, and what the board cannot do is refused here', async () => {
  let done: (outcome: Outcome) => void = () => undefined;
  const { session, asked } = await shared(() => new Promise((resolve) => (done = resolve)));
  const erased = session.erase();
  expect(session.state.activity).toEqual({ kind: 'erasing' });
  done('acknowledged');
  await erased;
  expect(session.state.activity).toEqual({ kind: 'idle' });
  await expect(session.setSpeed(null, 50)).rejects.toMatchObject({ code: 'notSupported' });
  await expect(session.release([1])).rejects.toMatchObject({ code: 'notSupported' });
  expect(asked).toEqual([['erase']]);
});

test('what leaves there stands in the log once, by its word', async () => {
  const { session, left } = await shared(() => Promise.resolve('sent'));
  const kinds: (string | undefined)[] = [];
  session.subscribe({
    traffic: (entry) => entry.direction === 'out' && kinds.push(entry.command?.kind),
  });
  left(RUN);
  await session.sendRaw(encodeCommand({ kind: 'stop' }, familyOf('doc')));
  expect(kinds).toEqual(['run']);
});

test('a question that only other boards know is told with its bytes: a board is asked who it is', async () => {
  const { session, left } = await shared(() => Promise.resolve('sent'));
  const packets: Uint8Array[] = [];
  session.subscribe({ traffic: (entry) => entry.direction === 'out' && packets.push(entry.bytes) });
  left({ kind: 'readVersion' });
  left({ kind: 'readPositions', servos: [1] });
  expect(packets).toEqual([fromHex('55550201'), fromHex('555504150101')]);
});
