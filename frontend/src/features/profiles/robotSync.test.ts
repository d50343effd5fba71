import { describe, expect, test } from 'vitest';
import { LibraryError, type DocumentStore } from '#shared/files/documentStore.ts';
import { addPose, markApplied } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryStore } from '../library/memoryStore.ts';
import { createVisit, named, nextId } from './robotVisitUnderTest.ts';

const limited = (robot: Robot): Robot => changeServo(robot, 4, { min: 1000 });
const narrowed = (robot: Robot): Robot => changeServo(robot, 4, { max: 2000 });

/** Two screens at one library: the second one comes later. */
async function twoScreens(clock: VirtualClock, documentStore: DocumentStore) {
  const one = createVisit(documentStore, clock);
  await clock.advance(300);
  one.robots.edit(() => 'rename', named('Crane'));
  await clock.advance(300);
  const other = createVisit(documentStore, clock);
  await clock.advance(300);
  return { one, other };
}

describe('robots in the library', () => {
  test('what is described on one screen is on the next one, with all that belongs to it', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const one = createVisit(documentStore, clock);
    one.robots.edit(() => 'rename', named('Crane'));
    one.capture('Wave');
    await clock.advance(300);
    const other = createVisit(documentStore, clock);
    await clock.advance(300);
    // In place of the one without a description.
    expect(other.names()).toEqual(['Crane']);
    expect(other.poses()).toEqual(['Wave']);
    expect(other.noticeTexts()).toEqual([]);
    other.robots.edit(() => 'limits', limited);
    other.capture('Bow');
    await clock.advance(300);
    one.robotSync.refresh();
    await clock.advance(300);
    expect(one.robots.current().robot.servos[3]?.min).toBe(1000);
    expect(one.poses()).toEqual(['Wave', 'Bow']);
  });

  test('the library gets limits and poses as the board counts', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const one = createVisit(documentStore, clock);
    one.robots.edit(() => 'limits', limited);
    one.capture('Wave');
    await clock.advance(300);
    const { documents } = await documentStore.list();
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

  test('a robot without a description stays here until it is wanted, and is one wherever it is made', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const [one, other] = [createVisit(documentStore, clock), createVisit(documentStore, clock)];
    await clock.advance(300);
    expect((await documentStore.list()).documents).toEqual([]);
    const results = [one, other].map(({ robotSync, robots }) => robotSync.keep(robots.current().id));
    await clock.advance(300);
    expect(await Promise.all(results)).toEqual(['usual-doc', 'usual-doc']);
    expect((await documentStore.list()).documents).toHaveLength(1);
  });

  test('changes of different parts go together, of the same part both are kept', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const { one, other } = await twoScreens(clock, documentStore);
    one.robots.edit(() => 'limits', limited);
    other.capture('Bow');
    await clock.advance(600);
    one.robotSync.refresh();
    other.robotSync.refresh();
    await clock.advance(600);
    for (const screen of [one, other]) {
      expect(screen.robots.current().robot.servos[3]?.min).toBe(1000);
      expect(screen.poses()).toEqual(['Bow']);
      expect(screen.noticeTexts()).toEqual([]);
    }
    one.robots.edit(() => 'limits', narrowed);
    other.robots.edit(() => 'rename', named('Digger'));
    await clock.advance(600);
    one.robotSync.refresh();
    other.robotSync.refresh();
    await clock.advance(600);
    for (const screen of [one, other]) expect(screen.names()).toEqual(['Crane', 'Digger, other version']);
    expect([...one.noticeTexts(), ...other.noticeTexts()]).toEqual([
      expect.stringContaining('Digger, other version'),
    ]);
  });

  test('what was described before there was a library comes beside what is there, and is reported', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    await twoScreens(clock, documentStore);
    const texts = new Map<string, string>();
    const away: DocumentStore = { ...documentStore, list: () => new Promise(() => undefined) };
    createVisit(away, clock, texts).robots.edit(() => 'rename', named('My hand'));
    const back = createVisit(documentStore, clock, texts);
    await clock.advance(300);
    expect(back.names()).toEqual(['My hand', 'Crane']);
    expect(back.noticeTexts()).toEqual([expect.stringContaining('My hand')]);
    const third = createVisit(documentStore, clock);
    await clock.advance(300);
    expect(third.names()).toEqual(['Crane', 'My hand']);
  });

  test('what another screen did is no step of this one, unless it would undo what was done here', async () => {
    const clock = createVirtualClock();
    const { one, other } = await twoScreens(clock, createMemoryStore('gateway'));
    one.robots.edit(() => 'limits', limited);
    await clock.advance(300);
    other.robotSync.refresh();
    await clock.advance(300);
    expect(other.robots.store.getState().past).toEqual([]);
    other.robots.edit(() => 'rename', named('Digger'));
    await clock.advance(300);
    one.robotSync.refresh();
    await clock.advance(300);
    expect(one.robots.current().robot.name).toBe('Digger');
    one.robots.undo();
    expect(one.robots.current().robot.name).toBe('Crane');
    expect(one.robots.current().robot.servos[3]?.min).toBe(1000);
  });

  test('a robot that is removed goes everywhere, and comes back where it may not be removed', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const { one, other } = await twoScreens(clock, documentStore);
    one.robots.duplicate();
    await clock.advance(300);
    other.robotSync.refresh();
    await clock.advance(300);
    expect(other.names()).toEqual(['Crane', 'Crane, copy']);
    one.robots.remove(one.robots.current().id);
    await clock.advance(300);
    other.robotSync.refresh();
    await clock.advance(300);
    expect(other.names()).toEqual(['Crane']);
    const strict: DocumentStore = {
      ...documentStore,
      remove: () => Promise.reject(new LibraryError('failed', 'Only an owner may remove')),
    };
    const driver = createVisit(strict, clock);
    await clock.advance(300);
    driver.robots.duplicate();
    await clock.advance(300);
    driver.robots.remove(driver.robots.current().id);
    await clock.advance(6000);
    expect(driver.names()).toEqual(['Crane', 'Crane, copy']);
    expect(driver.noticeTexts()).toEqual([expect.stringContaining('Only an owner may remove')]);
  });

  test('a library that is away is reported once, and gets everything when it is back', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    let isAway = true;
    const list: DocumentStore['list'] = () =>
      isAway ? Promise.reject(new LibraryError('unreachable', '')) : documentStore.list();
    const one = createVisit({ ...documentStore, list }, clock);
    one.robots.edit(() => 'rename', named('Crane'));
    await clock.advance(20_000);
    expect(one.noticeTexts()).toHaveLength(1);
    isAway = false;
    await clock.advance(6000);
    expect((await documentStore.list()).documents.map(({ facts }) => facts.name)).toEqual(['Crane']);
  });

  test('another library gets what it has never seen, under the same name', async () => {
    const clock = createVirtualClock();
    const texts = new Map<string, string>();
    const first = createMemoryStore('gateway');
    createVisit(first, clock, texts).robots.edit(() => 'rename', named('Crane'));
    await clock.advance(300);
    const second = createMemoryStore('gateway');
    createVisit(second, clock, texts);
    await clock.advance(300);
    const ids = async (documentStore: DocumentStore) =>
      (await documentStore.list()).documents.map(({ id }) => id);
    expect(await ids(second)).toEqual(await ids(first));
  });

  test('where the robot went last is of no interest elsewhere', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    const { one } = await twoScreens(clock, documentStore);
    one.capture('Wave');
    await clock.advance(300);
    const [before] = (await documentStore.list()).documents;
    one.book.edit(
      () => 'go',
      (book) => markApplied(book, 1),
    );
    await clock.advance(300);
    expect((await documentStore.list()).documents).toEqual([before]);
  });

  test('who may only look takes what comes and hands in nothing', async () => {
    const clock = createVirtualClock();
    const documentStore = createMemoryStore('gateway');
    await twoScreens(clock, documentStore);
    const before = await documentStore.list();
    const viewer = createVisit(documentStore, clock, new Map(), false);
    await clock.advance(300);
    expect(viewer.names()).toEqual(['Crane']);
    expect(await viewer.robotSync.keep(viewer.robots.current().id)).not.toBeNull();
    viewer.robots.add(() => 'add', named(nextId())(viewer.robots.current().robot));
    await clock.advance(300);
    expect(await documentStore.list()).toEqual(before);
  });
});

test('poses are found again under the number they have here', async () => {
  const clock = createVirtualClock();
  const documentStore = createMemoryStore('gateway');
  const { one, other } = await twoScreens(clock, documentStore);
  one.book.edit(
    () => 'capture',
    (book) => addPose(book, { name: 'Sit', unit: 'us', targets: [{ servo: 1, position: 1200 }] }),
  );
  await clock.advance(300);
  other.robotSync.refresh();
  await clock.advance(300);
  const [document] = (await documentStore.list()).documents;
  expect(other.robotSync.robotOf(document?.id ?? '')).toBe(other.robots.current().id);
  expect(other.robotSync.robotOf('none')).toBeNull();
  expect(other.poses()).toEqual(['Sit']);
});
