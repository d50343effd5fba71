// The client as a program uses it: from Node, against a real gateway on the simulated board.

import { createServer, request as forward } from 'node:http';
import type { AddressInfo } from 'node:net';
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest';
import type { Command, CommandKind } from '../codec/commands.ts';
import { startGateway, type GatewayUnderTest } from './gatewayUnderTest.ts';
import { GatewayError, Servodeck, TimedOutError, UnreachableError } from './servodeck.ts';

/** Time-outs here are 500 ms; a quiet computer takes 600. */
const BUSY_MS = 900;
let gateway: GatewayUnderTest;
let robot: Servodeck;
let begun = 0;

beforeAll(async () => {
  gateway = await startGateway();
});
afterAll(() => gateway.end());
beforeEach(() => {
  robot = new Servodeck(gateway.url);
  begun = gateway.heard().length;
});
afterEach(async () => {
  await robot.close();
  const next = new Servodeck(gateway.url);
  await next.resume();
  await next.close();
});

/** What the board has heard in this test. */
function heard<K extends CommandKind>(kind: K): readonly Extract<Command, { kind: K }>[] {
  return gateway
    .heard()
    .slice(begun)
    .filter((command): command is Extract<Command, { kind: K }> => command.kind === kind);
}

const moves = (): readonly Readonly<Record<string, number>>[] =>
  heard('move').map(({ durationMs, targets }) => ({
    durationMs,
    ...Object.fromEntries(targets.map(({ servo, position }) => [servo, position])),
  }));

const codeOf = (work: Promise<unknown>): Promise<unknown> =>
  work.then(
    () => 'none',
    (error: unknown) => (error instanceof GatewayError ? error.code : error),
  );

test('it moves by name in degrees, goes to poses, stores, runs and plays', async () => {
  const servos = await robot.servos();
  expect(servos.map(({ name }) => name)).toEqual(['Base', 'Elbow', 'Gripper']);
  await robot.move({ Base: 30, elbow: 10, 3: 0 }, { units: 'deg' });
  expect(moves()).toEqual([
    { durationMs: 1500, 1: 1800 },
    { durationMs: 1500, 2: 1420 },
    { durationMs: 1500, 3: 1500 },
  ]);
  await robot.move({ Base: 1500, 2: 1520 }, { units: 'board', seconds: 0.1 });
  expect(moves().at(-1)).toEqual({ durationMs: 100, 1: 1500, 2: 1520 });
  expect(await robot.poses()).toEqual({ 0: 'home', 1: 'Greeting' });
  await robot.pose('Greeting', { seconds: 0.1 });
  expect(moves().at(-1)).toEqual({ durationMs: 100, 1: 1700 });

  const frames = [
    [0.1, { Base: 10 }],
    [0.1, { Base: 0 }],
  ] as const;
  const job = await robot.download(7, frames, { units: 'deg', name: 'Nod' });
  expect(job).toMatchObject({ status: 'done', groupsStored: 1 });
  expect((await robot.snapshot()).groups).toEqual({ 7: 'Nod' });
  expect(await robot.run('Nod', { times: 2 })).toBe('acknowledged');
  expect(heard('run')).toEqual([{ kind: 'run', slot: 7, times: 2 }]);
  expect((await robot.status()).running).toBeNull();
  expect(await robot.battery()).toBe(7500);
});

test('errors have the codes and sentences of the gateway, and two are of this side', async () => {
  await expect(robot.move({ Base: 95 }, { units: 'deg' })).rejects.toThrow(
    'Base (servo 1): position is 2450, allowed 600..2400',
  );
  expect(await codeOf(robot.move({ Base: 95 }, { units: 'deg' }))).toBe('outOfRange');
  expect(await codeOf(robot.move({ Wrist: 0 }, { units: 'deg' }))).toBe('notFound');
  expect(await codeOf(robot.pose('Bow'))).toBe('notFound');
  expect(await codeOf(robot.run('Wave'))).toBe('notFound');
  expect(await robot.stop()).toBeNull();
  expect(await codeOf(robot.pose('home'))).toBe('latched');
  await expect(new Servodeck('http://127.0.0.1:1').status()).rejects.toBeInstanceOf(UnreachableError);
  expect(() => new Servodeck('/dev/ttyUSB0')).toThrow(TypeError);
});

test('a motion that is not awaited to its end is stopped: by time, by a signal, by close', async () => {
  const endless = { times: 0, units: 'board', loopFrom: 0 } as const;
  const frames = [[0.5, { 1: 1500 }]] as const;
  await expect(robot.play(frames, { ...endless, timeout: 0.1 })).rejects.toBeInstanceOf(TimedOutError);
  expect((await robot.status()).play?.status).toBe('ended');

  const controller = new AbortController();
  const playing = robot.play(frames, { ...endless, timeout: 60, signal: controller.signal });
  for await (const event of robot.events())
    if (event.type === 'play' && event.play.status === 'playing') break;
  controller.abort(new Error('enough'));
  await expect(playing).rejects.toThrow('enough');
  expect((await robot.status()).play?.status).toBe('ended');

  await robot.play(frames, { ...endless, wait: false });
  expect((await robot.status()).play?.status).toBe('playing');
  await robot[Symbol.asyncDispose]();
  const status = await new Servodeck(gateway.url).status();
  expect(status).toMatchObject({ play: { status: 'ended' }, driver: null });
});

test('a closed robot refuses every method', async () => {
  await robot.close();
  await robot.close();
  const frames = [[0.5, { 1: 1500 }]] as const;
  for (const ask of [
    () => robot.move({ 1: 1500 }, { units: 'board' }),
    () => robot.pose('home'),
    () => robot.run(8),
    () => robot.play(frames, { units: 'board' }),
    () => robot.download(8, frames, { units: 'board' }),
    () => robot.erase(),
    () => robot.stop(),
    () => robot.resume(),
    () => robot.requestLease(),
    () => robot.release(),
    () => robot.snapshot(),
    () => robot.status(),
    () => robot.battery(),
    () => robot.poses(),
    () => robot.servos(),
    () => robot.events().next(),
  ])
    expect(await codeOf(ask())).toBe('closed');
});

test('unknown units and options, and a servo that is named twice, are refused by name', async () => {
  const frames = [[1.5, { 1: 30 }]] as const;
  for (const word of ['degrees', 'rad', 'Deg', '']) {
    const units = word as 'deg';
    const said = `units is ${word}, allowed: deg, board`;
    await expect(robot.move({ 1: 30 }, { units })).rejects.toThrow(said);
    await expect(robot.play(frames, { units })).rejects.toThrow(said);
    await expect(robot.download(5, frames, { units })).rejects.toThrow(said);
  }
  const misspelt = { units: 'deg', second: 3 } as { units: 'deg' };
  await expect(robot.move({ 1: 30 }, misspelt)).rejects.toThrow('second is no option of this method.');
  await expect(robot.pose('home', misspelt as object)).rejects.toThrow('units is no option of this method.');
  await expect(robot.move({ Base: 10, 1: -10 }, { units: 'deg' })).rejects.toThrow(
    'Servo 1 is named twice, the second time as Base',
  );
  // What still comes are the stops of the test before.
  expect(moves().filter(({ durationMs }) => durationMs !== 20)).toEqual([]);
  expect(heard('download')).toEqual([]);
});

test('a time-out ends the motion on time', async () => {
  const frames = [
    [1.5, { 1: 1800 }],
    [2, { 1: 1200 }],
  ] as const;
  for (const begin of [
    () => robot.move({ 1: 1800 }, { units: 'board', seconds: 5, timeout: 0.5 }),
    () => robot.pose('home', { seconds: 5, timeout: 0.5 }),
    () => robot.play(frames, { units: 'board', timeout: 0.5 }),
    () => robot.run(8, { timeout: 0.5 }),
  ]) {
    const beganMs = performance.now();
    await expect(begin()).rejects.toBeInstanceOf(TimedOutError);
    expect(performance.now() - beganMs).toBeLessThan(BUSY_MS);
  }
});

test('a gateway that vanishes is noticed within the time-out, whatever was asked', async () => {
  const silent = createServer(() => undefined);
  await new Promise<void>((resolve) => void silent.listen(0, '127.0.0.1', resolve));
  const far = new Servodeck(`http://127.0.0.1:${(silent.address() as AddressInfo).port}`, { timeout: 0.5 });
  const frames = [[0.5, { 1: 1500 }]] as const;
  const beganMs = performance.now();
  const asked = [
    far.move({ 1: 1500 }, { units: 'board' }),
    far.pose('home'),
    far.run(8),
    far.play(frames, { units: 'board' }),
    far.download(8, frames, { units: 'board' }),
    far.snapshot(),
    far.stop(),
  ];
  for (const answer of await Promise.allSettled(asked))
    expect(answer).toMatchObject({ status: 'rejected', reason: { name: 'UnreachableError' } });
  expect(performance.now() - beganMs).toBeLessThan(BUSY_MS);
  silent.closeAllConnections();
  silent.close();
});

test('a request whose answer was lost is sent again with its key, and moves the robot once', async () => {
  const keys: unknown[] = [];
  // Passes requests on, and loses the first answer to a move.
  const relay = createServer((from, to) => {
    if (from.url === '/api/move') keys.push(from.headers['idempotency-key']);
    const isLost = from.url === '/api/move' && keys.length === 1;
    const { host } = new URL(gateway.url);
    const onward = forward(
      `${gateway.url}${from.url}`,
      { method: from.method, headers: { ...from.headers, host } },
      (answer) => {
        if (isLost) answer.resume().on('end', () => to.destroy());
        else answer.pipe(to.writeHead(answer.statusCode ?? 0, answer.headers));
      },
    );
    from.pipe(onward);
  });
  await new Promise<void>((resolve) => void relay.listen(0, '127.0.0.1', resolve));
  const far = new Servodeck(`http://127.0.0.1:${(relay.address() as AddressInfo).port}`);
  await far.status();
  await far.move({ 1: 1600 }, { units: 'board' });
  await far.close();
  relay.closeAllConnections();
  relay.close();
  expect(keys).toHaveLength(2);
  expect(new Set(keys).size).toBe(1);
  // The servos that a stop before has held have moves of their own.
  expect(moves().filter((move) => move[1] === 1600)).toHaveLength(1);
});

test('events begin with the whole state and tell each change, until the time is over', async () => {
  const types: string[] = [];
  for await (const event of robot.events()) {
    types.push(event.type);
    if (event.type === 'welcome') await robot.stop();
    if (event.type === 'state' && event.latch) break;
  }
  expect(types[0]).toBe('welcome');
  const ended: string[] = [];
  for await (const event of robot.events({ seconds: 0.3 })) ended.push(event.type);
  expect(ended[0]).toBe('welcome');
});
