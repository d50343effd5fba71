import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import type { FleetChanges, FleetStopped } from '#shared/client/http.generated.ts';
import type { FleetApi } from './fleetApi.ts';
import { createFleet } from './fleetStore.ts';
import { fleetRobot } from './samples.ts';
import { stopText } from './stopText.ts';

const CHANGES: FleetChanges = {
  ...{ revision: 1, isWhole: true, site: 'lab', broker: { status: 'connected', detail: '' } },
  ...{ robots: [], removed: [], tasks: [], events: [], cues: [] },
};

/** Answers in this order, and what was asked for; then the page is left. */
function followed(answers: readonly (Partial<FleetChanges> | Error)[], api: Partial<FleetApi> = {}) {
  const asked: number[] = [];
  const left = new AbortController();
  const waiting = [...answers];
  const unused = (): never => {
    throw new Error('not asked for');
  };
  const whole: FleetApi = {
    changes(since) {
      asked.push(since);
      const answer = waiting.shift();
      if (waiting.length === 0) left.abort();
      return answer instanceof Error ? Promise.reject(answer) : Promise.resolve({ ...CHANGES, ...answer });
    },
    ...{
      stop: unused,
      run: unused,
      download: unused,
      resume: unused,
      drive: unused,
      retry: unused,
      group: unused,
      setCues: unused,
    },
    ...api,
  };
  const clock = createVirtualClock();
  const fleet = createFleet(whole, { list: unused, read: unused }, clock);
  return { fleet, clock, asked, done: fleet.follow(left.signal) };
}

test('a robot is in the group that it was put into, at once, and the others stay in theirs', async () => {
  const robots = [fleetRobot('a', { groups: ['Table 1'] }), fleetRobot('b', { groups: ['Table 1'] })];
  const asked: unknown[] = [];
  const group = (...wish: unknown[]) => Promise.resolve(void asked.push(wish));
  const { fleet, done } = followed([{ robots }], { group });
  await done;
  await fleet.group(['a'], 'Table 2');
  expect(fleet.store.getState().robots.map(({ groups }) => groups)).toEqual([['Table 2'], ['Table 1']]);
  await fleet.group(['a'], '');
  expect(fleet.store.getState().robots[0]?.groups).toEqual([]);
  expect(asked).toEqual([
    [['a'], 'Table 2'],
    [['a'], ''],
  ]);
});

test('changes are merged into what is known, and what is gone leaves the selection', async () => {
  const [one, other] = [fleetRobot('a'), fleetRobot('b')];
  const stopped = fleetRobot('a', { state: { latch: true } });
  const { fleet, asked, done } = followed([
    { revision: 4, robots: [one, other] },
    { revision: 6, isWhole: false, robots: [stopped], removed: ['b'] },
  ]);
  fleet.selectOnly(['a', 'b']);
  await done;
  expect(asked).toEqual([0, 4]);
  expect(fleet.store.getState().robots).toEqual([stopped]);
  expect([...fleet.store.getState().selected]).toEqual(['a']);
});

test('a gateway that started again sends all of it, in place of what was known', async () => {
  const { fleet, done } = followed([
    { revision: 90, robots: [fleetRobot('a'), fleetRobot('b')] },
    { revision: 2, isWhole: true, robots: [fleetRobot('c')] },
  ]);
  await done;
  expect(fleet.store.getState().robots.map(({ id }) => id)).toEqual(['c']);
});

test('while the gateway is away the page says so, and asks for all of it later', async () => {
  const { fleet, clock, asked, done } = followed([
    { revision: 4, robots: [fleetRobot('a')] },
    new GatewayProblem(null, 'the gateway does not answer'),
    { revision: 5, robots: [fleetRobot('a')] },
  ]);
  await clock.advance(0);
  expect(fleet.store.getState().problem).toBe('');
  expect(fleet.store.getState().robots).toHaveLength(1);
  await clock.advance(1000);
  await done;
  expect(asked).toEqual([0, 4, 0]);
  expect(fleet.store.getState().problem).toBeNull();
});

test('a stop says whom it has not reached, and that it was not sent at all', async () => {
  const { fleet } = followed([{}], {
    stop: (robots) =>
      robots === null
        ? Promise.reject(new GatewayProblem('internal', 'The broker is gone.'))
        : Promise.resolve({ reached: ['a'], notReached: ['b'] }),
  });
  await fleet.stop(['a', 'b']);
  expect(fleet.store.getState().stopping).toEqual({ count: 2, notReached: ['b'], problem: null });
  await fleet.stop(null);
  expect(fleet.store.getState().stopping?.problem).toBe('The broker is gone.');
});

test('a stop that no gateway has answered may have been sent all the same', async () => {
  const { fleet } = followed([{}], {
    stop: () => Promise.reject(new GatewayProblem(null, 'the gateway does not answer')),
  });
  await fleet.stop(null);
  const { stopping } = fleet.store.getState();
  expect(stopping).not.toBeNull();
  expect(stopping && stopText(stopping, [])).toContain('Stop may not have been sent.');
});

test('as many are counted as the gateway has stopped, also those that this page has not heard of', async () => {
  const { fleet } = followed([{}], {
    stop: () => Promise.resolve({ reached: ['a', 'b'], notReached: ['c'] }),
  });
  await fleet.stop(null);
  expect(fleet.store.getState().stopping).toEqual({ count: 3, notReached: ['c'], problem: null });
});

test('a stop of others does not hide whom the one before has not reached', async () => {
  const { fleet } = followed([{}], {
    stop: (robots) =>
      Promise.resolve({ reached: [...(robots ?? ['a'])], notReached: robots === null ? ['b'] : [] }),
  });
  const shown = () => fleet.store.getState().stopping;
  await fleet.stop(null);
  await fleet.stop(['a']);
  expect(shown()).toEqual({ count: 2, notReached: ['b'], problem: null });
  await fleet.stop(['b']);
  expect(shown()).toEqual({ count: 1, notReached: [], problem: null });
});

test('the answer to a stop that comes after that to a newer one adds only whom it has not reached', async () => {
  const answers: ((stopped: FleetStopped) => void)[] = [];
  const { fleet } = followed([{}], { stop: () => new Promise((resolve) => answers.push(resolve)) });
  const shown = () => fleet.store.getState().stopping;
  const all = fleet.stop(null);
  const one = fleet.stop(['a']);
  answers[1]?.({ reached: ['a'], notReached: [] });
  await one;
  expect(shown()).toEqual({ count: 1, notReached: [], problem: null });
  answers[0]?.({ reached: ['c'], notReached: ['a', 'b'] });
  await all;
  expect(shown()).toEqual({ count: 2, notReached: ['b'], problem: null });
});

test('what a stop did is shown until all have resumed', async () => {
  const at = (latch: boolean) => [fleetRobot('a', { state: { latch } }), fleetRobot('b')];
  const { fleet, done } = followed([
    { revision: 1, robots: at(false) },
    { revision: 2, robots: at(true) },
    { revision: 3, robots: at(false) },
  ]);
  const shown: (number | undefined)[] = [];
  fleet.store.setState({ stopping: { count: 2, notReached: [], problem: null } });
  fleet.store.subscribe(({ stopping }) => shown.push(stopping?.count));
  await done;
  expect(shown).toEqual([2, 2, undefined]);
});
