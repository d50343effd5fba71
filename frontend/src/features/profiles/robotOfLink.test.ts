import { describe, expect, test } from 'vitest';
import type { Robot } from '#shared/profile/robot.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { Lease } from '#shared/robot/lease.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { SessionState } from '#shared/robot/state.ts';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { createMemoryStore } from '../library/memoryStore.ts';
import { DIFFERS_AFTER_MS, followRobot } from './robotOfLink.ts';
import { words } from '../../i18n/words.ts';
import { freshRobot } from './robots.ts';
import { createVisit, named } from './robotVisitUnderTest.ts';

const LEASE: Lease = {
  ...{ driver: null, drives: false, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{
    you: 'Ben',
    mayDrive: true,
    mayTake: false,
    grantedBy: null,
    candidates: [],
    others: 1,
    unattended: null,
  },
};

const narrowed = (robot: Robot): Robot => changeServo(robot, 4, { max: 2000 });

const FASTER = 'Another robot was put there meanwhile.';

/** What a gateway does: which robot is on the board, reported to every screen. */
function createGateway(clock: VirtualClock) {
  const screens = new Set<(document: string | null) => void>();
  let document: string | null = null;
  let refusal: LinkError | null = null;
  let answerMs = 0;
  return {
    requested: [] as string[],
    document: () => document,
    refuseBy: (error: LinkError | null) => (refusal = error),
    answerAfter: (delayMs: number) => (answerMs = delayMs),
    async put(this: { requested: string[] }, next: string, insteadOf: string | null): Promise<void> {
      this.requested.push(next);
      await Promise.resolve();
      if (refusal !== null) throw refusal;
      if (next !== document && insteadOf !== document) throw new LinkError('gatewayRefused', FASTER);
      document = next;
      // The answer may come before the word to everybody.
      clock.after(50, () => {
        for (const tell of screens) tell(next);
      });
      if (answerMs > 0) await new Promise<void>((resolve) => clock.after(answerMs, resolve));
    },
    join(tell: (document: string | null) => void): void {
      screens.add(tell);
      tell(document);
    },
  };
}

type Gateway = ReturnType<typeof createGateway>;

function createScreen(
  gateway: Gateway,
  documentStore: DocumentStore,
  clock: VirtualClock,
  mayWrite = true,
  texts = new Map<string, string>(),
) {
  const visit = createVisit(documentStore, clock, texts, mayWrite);
  let state: SessionState = {
    ...INITIAL_STATE,
    ...{ family: FAMILIES.doc, link: { status: 'ready' }, lease: LEASE },
  };
  const note = followRobot({ ...visit, clock, mayWrite, putOnBoard: (...put) => gateway.put(...put) });
  const change = (patch: Partial<SessionState>): void => note((state = { ...state, ...patch }));
  gateway.join((document) => change({ robotOnBoard: { document } }));
  return {
    ...visit,
    change,
    inUse: () => visit.robots.current().robot.name,
    isTheBoards: () => visit.robotSync.robotOf(gateway.document() ?? '') === visit.robots.current().id,
  };
}

function lesson() {
  const clock = createVirtualClock();
  return { clock, gateway: createGateway(clock), documentStore: createMemoryStore('gateway') };
}

describe('the robot of a shared board', () => {
  test('is the usual one where there is no description, the same for two screens at once', async () => {
    const { clock, gateway, documentStore } = lesson();
    const screens = [
      createScreen(gateway, documentStore, clock),
      createScreen(gateway, documentStore, clock),
    ];
    await clock.advance(1000);
    expect(gateway.document()).toBe('usual-doc');
    expect(gateway.requested).toHaveLength(2);
    for (const screen of screens) {
      expect(screen.isTheBoards()).toBe(true);
      expect(screen.names()).toHaveLength(1);
      expect(screen.noticeTexts()).toEqual([]);
    }
  });

  test('is at hand of a page that joins, and each edit follows', async () => {
    const { clock, gateway, documentStore } = lesson();
    const teacher = createScreen(gateway, documentStore, clock);
    teacher.robots.add(() => 'add', { ...freshRobot('arm', 'doc'), name: 'Crane' });
    await clock.advance(1000);
    const pupil = createScreen(gateway, documentStore, clock);
    await clock.advance(1000);
    expect([pupil.inUse(), pupil.isTheBoards()]).toEqual(['Crane', true]);
    teacher.robots.edit(() => 'rename', named('Digger'));
    teacher.capture('Wave');
    await clock.advance(300);
    pupil.change({ robotOnBoard: { document: gateway.document() } });
    await clock.advance(300);
    expect([pupil.inUse(), pupil.poses()]).toEqual(['Digger', ['Wave']]);
  });

  test('is changed for everybody by the page that takes up another one', async () => {
    const { clock, gateway, documentStore } = lesson();
    const [one, other] = [
      createScreen(gateway, documentStore, clock),
      createScreen(gateway, documentStore, clock),
    ];
    await clock.advance(1000);
    one.robots.add(() => 'add', { ...freshRobot('hand', 'doc'), name: 'Hand' });
    await clock.advance(1000);
    expect([one.inUse(), other.inUse()]).toEqual(['Hand', 'Hand']);
    other.robots.takeUp(other.robots.store.getState().present.own[0]?.id ?? 0);
    await clock.advance(1000);
    expect(one.inUse()).toBe(other.inUse());
    expect(one.inUse()).not.toBe('Hand');
  });

  test('and its limits are left to the driver; poses are not', async () => {
    const { clock, gateway, documentStore } = lesson();
    const pupil = createScreen(gateway, documentStore, clock);
    await clock.advance(1000);
    pupil.change({ lease: { ...LEASE, driver: 'Ada' } });
    expect(pupil.robots.edit(() => 'limits', narrowed)).toBe(false);
    expect(pupil.noticeTexts().at(-1)).toContain('Ada drives');
    expect(pupil.robots.edit(() => 'rename', named('Crane'))).toBe(true);
    pupil.capture('Wave');
    expect(pupil.poses()).toEqual(['Wave']);
    pupil.robots.add(() => 'add', { ...freshRobot('hand', 'doc'), name: 'Hand' });
    expect(pupil.inUse()).toBe('Crane');
    for (const lease of [
      { driver: 'Ada', drives: true },
      { driver: 'Ada', mayTake: true },
      { driver: null },
    ]) {
      pupil.change({ lease: { ...LEASE, ...lease } });
      expect(pupil.robots.edit(() => 'limits', narrowed)).toBe(true);
      pupil.robots.undo();
    }
  });

  test('a viewer sees it and changes nothing', async () => {
    const { clock, gateway, documentStore } = lesson();
    const teacher = createScreen(gateway, documentStore, clock);
    teacher.robots.add(() => 'add', { ...freshRobot('arm', 'doc'), name: 'Crane' });
    await clock.advance(1000);
    const requested = gateway.requested.length;
    const viewer = createScreen(gateway, documentStore, clock, false);
    await clock.advance(1000);
    expect(viewer.inUse()).toBe('Crane');
    viewer.robots.edit(() => 'rename', named('Mine'));
    viewer.capture('Wave');
    const before = viewer.names();
    viewer.robots.duplicate();
    expect([viewer.inUse(), viewer.poses(), viewer.names()]).toEqual(['Crane', [], before]);
    expect(viewer.noticeTexts()[0]).toContain('Viewers');
    await clock.advance(1000);
    expect(gateway.requested).toHaveLength(requested);
  });

  test('what was put there stays at hand and is put once, however late the word about it comes', async () => {
    const { clock, gateway, documentStore } = lesson();
    const one = createScreen(gateway, documentStore, clock);
    const putTimes: number[] = [];
    for (const wish of [() => undefined, () => one.robots.duplicate()]) {
      wish();
      const { id } = one.robots.current();
      const requested = gateway.requested.length;
      while (gateway.requested.length === requested) await clock.advance(1);
      for (const status of ['ready', 'identifying', 'ready'] as const) {
        one.change({ link: { status } });
        await clock.advance(5);
        expect(one.robots.current().id).toBe(id);
      }
      await clock.advance(1000);
      expect(one.isTheBoards()).toBe(true);
      putTimes.push(gateway.requested.length - requested);
    }
    expect(putTimes).toEqual([1, 1]);
    expect(one.noticeTexts()).toEqual([]);
  });

  test('is the one that was put there last, also where the word about it overtakes the answer', async () => {
    const { clock, gateway, documentStore } = lesson();
    const [one, other] = [
      createScreen(gateway, documentStore, clock),
      createScreen(gateway, documentStore, clock),
    ];
    await clock.advance(1000);
    const first = gateway.document() ?? '';
    gateway.answerAfter(200);
    one.robots.duplicate();
    while (gateway.document() === first) await clock.advance(1);
    gateway.answerAfter(0);
    await gateway.put(first, gateway.document());
    await clock.advance(1000);
    expect(gateway.document()).toBe(first);
    expect([one.isTheBoards(), other.isTheBoards()]).toEqual([true, true]);
  });

  test('is put there by a page that was not ready when it was kept, as soon as that is over', async () => {
    const { clock, gateway, documentStore } = lesson();
    const one = createScreen(gateway, documentStore, clock);
    one.change({ link: { status: 'identifying' } });
    await clock.advance(1000);
    expect(gateway.requested).toEqual([]);
    one.change({ link: { status: 'ready' } });
    await clock.advance(1000);
    expect(one.isTheBoards()).toBe(true);
  });

  test('the slower page takes up what was put there, and asks no more', async () => {
    const { clock, gateway, documentStore } = lesson();
    const described = ['Crane', 'Digger'].map((name) => {
      const { robots, texts } = createVisit(createMemoryStore('browser'), clock);
      robots.edit(() => 'rename', named(name));
      return texts;
    });
    const screens = described.map((texts) => createScreen(gateway, documentStore, clock, true, texts));
    const refusals = (): number =>
      screens.flatMap(({ noticeTexts }) => noticeTexts()).filter((text) => text.includes(FASTER)).length;
    for (const noticeTexts of [0, 1]) {
      const requested = gateway.requested.length;
      while (gateway.requested.length < requested + 2) await clock.advance(1);
      for (const status of ['identifying', 'ready'] as const)
        for (const { change } of screens) change({ link: { status } });
      await clock.advance(1000);
      expect(gateway.requested).toHaveLength(requested + 2);
      expect(screens.map(({ isTheBoards }) => isTheBoards())).toEqual([true, true]);
      // A wish that a person had is not lost without a word.
      expect(refusals()).toBe(noticeTexts);
      for (const { robots } of screens) robots.duplicate();
    }
  });

  test('who described one before the word came that another page was faster asks nothing either', async () => {
    const { clock, gateway, documentStore } = lesson();
    gateway.refuseBy(new LinkError('gatewayRefused', FASTER));
    const one = createScreen(gateway, documentStore, clock);
    while (gateway.requested.length === 0) await clock.advance(1);
    one.robots.duplicate();
    await clock.advance(1000);
    expect(gateway.requested).toEqual(['usual-doc']);
    gateway.refuseBy(null);
    one.change({ robotOnBoard: { document: null } });
    await clock.advance(1000);
    expect(one.isTheBoards()).toBe(true);
  });

  test('stays what it is where the gateway refuses another one, and a notice says so once', async () => {
    const { clock, gateway, documentStore } = lesson();
    const one = createScreen(gateway, documentStore, clock);
    await clock.advance(1000);
    const before = one.inUse();
    gateway.refuseBy(new LinkError('gatewayRefused', 'Somebody else drives.'));
    one.robots.add(() => 'add', { ...freshRobot('hand', 'doc'), name: 'Hand' });
    await clock.advance(1000);
    expect(one.inUse()).toBe(before);
    expect(one.noticeTexts()).toHaveLength(1);
    expect(gateway.requested.filter((document) => document !== 'usual-doc')).toHaveLength(1);
  });

  test('a link of its own asks nothing, and nothing is asked before it is ready', async () => {
    const { clock, gateway, documentStore } = lesson();
    const screen = createScreen(gateway, documentStore, clock);
    screen.change({ link: { status: 'opening' } });
    await clock.advance(1000);
    const requested = gateway.requested.length;
    screen.change({ link: { status: 'ready' }, robotOnBoard: null });
    screen.robots.add(() => 'add', { ...freshRobot('hand', 'doc'), name: 'Hand' });
    await clock.advance(1000);
    expect(gateway.requested).toHaveLength(requested);
    expect(screen.inUse()).toBe('Hand');
  });

  test('that this page cannot read is told, and another one may be chosen instead of it', async () => {
    const { clock, gateway, documentStore } = lesson();
    const screen = createScreen(gateway, documentStore, clock);
    await clock.advance(1000);
    await gateway.put('unreadable', gateway.document());
    await clock.advance(DIFFERS_AFTER_MS - 100);
    expect(screen.noticeTexts()).toEqual([]);
    await clock.advance(200);
    expect(screen.noticeTexts()).toEqual([words.robots.otherAtGateway({ name: screen.inUse() })]);
    expect(gateway.document()).toBe('unreadable');
    screen.robots.add(() => 'add', { ...freshRobot('hand', 'doc'), name: 'Hand' });
    await clock.advance(1000);
    expect([screen.isTheBoards(), screen.inUse()]).toEqual([true, 'Hand']);
    expect(screen.noticeTexts()).toEqual([]);
  });

  test('that the gateway does not have is told to those who cannot put one there', async () => {
    const { clock, gateway, documentStore } = lesson();
    const screen = createScreen(gateway, documentStore, clock, false);
    await clock.advance(DIFFERS_AFTER_MS + 100);
    expect(screen.noticeTexts()).toEqual([words.robots.noneAtGateway({ name: screen.inUse() })]);
    const teacher = createScreen(gateway, documentStore, clock);
    await clock.advance(1000);
    expect(teacher.noticeTexts()).toEqual([]);
    expect([screen.isTheBoards(), screen.noticeTexts()]).toEqual([true, []]);
  });
});
