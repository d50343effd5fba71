import { describe, expect, test } from 'vitest';
import { LibraryError, type DocumentStore } from '#shared/files/documentStore.ts';
import { addPose, markApplied } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryKeeper } from '../library/memoryKeeper.ts';
import { createVisit, named, nextId } from './robotVisitUnderTest.ts';

const limited = (robot: Robot): Robot => changeServo(robot, 4, { min: 1000 });
const narrowed = (robot: Robot): Robot => changeServo(robot, 4, { max: 2000 });

/** Two screens at one library: the second one comes later. */
async function twoScreens(clock: VirtualClock, keeper: DocumentStore) {
  const one = createVisit(keeper, clock);
  await clock.advance(300);
  one.robots.edit(() => 'rename', named('Crane'));
  await clock.advance(300);
  const other = createVisit(keeper, clock);
  await clock.advance(300);
  return { one, other };
}

describe('robots in the library', () => {
  test('what is described on one screen is on the next one, with all that belongs to it', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const one = createVisit(keeper, clock);
    one.robots.edit(() => 'rename', named('Crane'));
    one.capture('Wave');
    await clock.advance(300);
    const other = createVisit(keeper, clock);
    await clock.advance(300);
    // In place of the one that nobody has described.
    expect(other.names()).toEqual(['Crane']);
    expect(other.poses()).toEqual(['Wave']);
    expect(other.told()).toEqual([]);
    other.robots.edit(() => 'limits', limited);
    other.capture('Bow');
    await clock.advance(300);
    one.keeping.refresh();
    await clock.advance(300);
    expect(one.robots.current().robot.servos[3]?.min).toBe(1000);
    expect(one.poses()).toEqual(['Wave', 'Bow']);
  });

  test('the library is told limits and poses as the board counts', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const one = createVisit(keeper, clock);
    one.robots.edit(() => 'limits', limited);
    one.capture('Wave');
    await clock.advance(300);
    const { documents } = await keeper.list();
    expect(documents.map(({ facts }) => facts)).toMatchObject([
      {
        kind: 'robot',
        board: 'doc',
        poses: [
          { id: 0, name: 'home' },
          { id: 1, name: 'Wave' },
        ],
      },
    ]);
  });

  test('a robot that nobody has described stays here until it is wanted, and is one wherever it is made', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const [one, other] = [createVisit(keeper, clock), createVisit(keeper, clock)];
    await clock.advance(300);
    expect((await keeper.list()).documents).toEqual([]);
    const kept = [one, other].map(({ keeping, robots }) => keeping.keep(robots.current().id));
    await clock.advance(300);
    expect(await Promise.all(kept)).toEqual(['usual-doc', 'usual-doc']);
    expect((await keeper.list()).documents).toHaveLength(1);
  });

  test('changes of different parts go together, of the same part both are kept', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const { one, other } = await twoScreens(clock, keeper);
    one.robots.edit(() => 'limits', limited);
    other.capture('Bow');
    await clock.advance(600);
    one.keeping.refresh();
    other.keeping.refresh();
    await clock.advance(600);
    for (const screen of [one, other]) {
      expect(screen.robots.current().robot.servos[3]?.min).toBe(1000);
      expect(screen.poses()).toEqual(['Bow']);
      expect(screen.told()).toEqual([]);
    }
    one.robots.edit(() => 'limits', narrowed);
    other.robots.edit(() => 'rename', named('Digger'));
    await clock.advance(600);
    one.keeping.refresh();
    other.keeping.refresh();
    await clock.advance(600);
    for (const screen of [one, other]) expect(screen.names()).toEqual(['Crane', 'Digger, other version']);
    expect([...one.told(), ...other.told()]).toEqual([expect.stringContaining('Digger, other version')]);
  });

  test('what was described before there was a library comes beside what is there, and is told', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    await twoScreens(clock, keeper);
    const texts = new Map<string, string>();
    const away: DocumentStore = { ...keeper, list: () => new Promise(() => undefined) };
    createVisit(away, clock, texts).robots.edit(() => 'rename', named('My hand'));
    const back = createVisit(keeper, clock, texts);
    await clock.advance(300);
    expect(back.names()).toEqual(['My hand', 'Crane']);
    expect(back.told()).toEqual([expect.stringContaining('My hand')]);
    const third = createVisit(keeper, clock);
    await clock.advance(300);
    expect(third.names()).toEqual(['Crane', 'My hand']);
  });

  test('what another screen did is no step of this one, unless it would undo what was done here', async () => {
    const clock = createVirtualClock();
    const { one, other } = await twoScreens(clock, createMemoryKeeper('gateway'));
    one.robots.edit(() => 'limits', limited);
    await clock.advance(300);
    other.keeping.refresh();
    await clock.advance(300);
    expect(other.robots.store.getState().past).toEqual([]);
    other.robots.edit(() => 'rename', named('Digger'));
    await clock.advance(300);
    one.keeping.refresh();
    await clock.advance(300);
    expect(one.robots.current().robot.name).toBe('Digger');
    one.robots.undo();
    expect(one.robots.current().robot.name).toBe('Crane');
    expect(one.robots.current().robot.servos[3]?.min).toBe(1000);
  });

  test('a robot that is removed goes everywhere, and comes back where nobody may remove it', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const { one, other } = await twoScreens(clock, keeper);
    one.robots.duplicate();
    await clock.advance(300);
    other.keeping.refresh();
    await clock.advance(300);
    expect(other.names()).toEqual(['Crane', 'Crane, copy']);
    one.robots.remove(one.robots.current().id);
    await clock.advance(300);
    other.keeping.refresh();
    await clock.advance(300);
    expect(other.names()).toEqual(['Crane']);
    const strict: DocumentStore = {
      ...keeper,
      remove: () => Promise.reject(new LibraryError('failed', 'Only an owner may remove')),
    };
    const driver = createVisit(strict, clock);
    await clock.advance(300);
    driver.robots.duplicate();
    await clock.advance(300);
    driver.robots.remove(driver.robots.current().id);
    await clock.advance(6000);
    expect(driver.names()).toEqual(['Crane', 'Crane, copy']);
    expect(driver.told()).toEqual([expect.stringContaining('Only an owner may remove')]);
  });

  test('a library that is away is told once, and gets everything when it is back', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    let isAway = true;
    const list: DocumentStore['list'] = () =>
      isAway ? Promise.reject(new LibraryError('unreachable', '')) : keeper.list();
    const one = createVisit({ ...keeper, list }, clock);
    one.robots.edit(() => 'rename', named('Crane'));
    await clock.advance(20_000);
    expect(one.told()).toHaveLength(1);
    isAway = false;
    await clock.advance(6000);
    expect((await keeper.list()).documents.map(({ facts }) => facts.name)).toEqual(['Crane']);
  });

  test('another library gets what it has never seen, under the same name', async () => {
    const clock = createVirtualClock();
    const texts = new Map<string, string>();
    const first = createMemoryKeeper('gateway');
    createVisit(first, clock, texts).robots.edit(() => 'rename', named('Crane'));
    await clock.advance(300);
    const second = createMemoryKeeper('gateway');
    createVisit(second, clock, texts);
    await clock.advance(300);
    const ids = async (keeper: DocumentStore) => (await keeper.list()).documents.map(({ id }) => id);
    expect(await ids(second)).toEqual(await ids(first));
  });

  test('where the robot went last is of no interest elsewhere', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    const { one } = await twoScreens(clock, keeper);
    one.capture('Wave');
    await clock.advance(300);
    const [before] = (await keeper.list()).documents;
    one.book.edit(
      () => 'go',
      (book) => markApplied(book, 1),
    );
    await clock.advance(300);
    expect((await keeper.list()).documents).toEqual([before]);
  });

  test('who may only look takes what comes and hands in nothing', async () => {
    const clock = createVirtualClock();
    const keeper = createMemoryKeeper('gateway');
    await twoScreens(clock, keeper);
    const before = await keeper.list();
    const viewer = createVisit(keeper, clock, new Map(), false);
    await clock.advance(300);
    expect(viewer.names()).toEqual(['Crane']);
    expect(await viewer.keeping.keep(viewer.robots.current().id)).not.toBeNull();
    viewer.robots.add(() => 'add', named(nextId())(viewer.robots.current().robot));
    await clock.advance(300);
    expect(await keeper.list()).toEqual(before);
  });
});

test('poses are found again under the number they have here', async () => {
  const clock = createVirtualClock();
  const keeper = createMemoryKeeper('gateway');
  const { one, other } = await twoScreens(clock, keeper);
  one.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Sit', unit: 'us', targets: [{ servo: 1, position: 1200 }] }),
  );
  await clock.advance(300);
  other.keeping.refresh();
  await clock.advance(300);
  const [document] = (await keeper.list()).documents;
  expect(other.keeping.robotOf(document?.id ?? '')).toBe(other.robots.current().id);
  expect(other.keeping.robotOf('none')).toBeNull();
  expect(other.poses()).toEqual(['Sit']);
});
