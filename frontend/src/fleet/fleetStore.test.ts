import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import type { FleetChanges } from '#shared/client/http.generated.ts';
import type { FleetApi } from './fleetApi.ts';
import { createFleet } from './fleetStore.ts';
import { fleetRobot } from './samples.ts';

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
      setGroups: unused,
      setCues: unused,
    },
    ...api,
  };
  const clock = createVirtualClock();
  const fleet = createFleet(whole, { list: unused, read: unused }, clock);
  return { fleet, clock, asked, done: fleet.follow(left.signal) };
}

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
  expect(fleet.store.getState().problem).toBe('the gateway does not answer');
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
