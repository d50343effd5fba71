import { compileSource } from '../../board/compile/compileSource.ts';
import { describe, expect, test } from 'vitest';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { emptyGroup, type ActionGroup } from '#shared/group/group.ts';
import { insertFrame, setMeta, type NewFrame } from '#shared/group/groupEdits.ts';
import { startHistory } from '#shared/document/history.ts';
import { positionAt, tracksOf } from '#shared/group/tracks.ts';
import type { Lease } from '#shared/robot/lease.ts';
import { downloadCancelled } from '../../../i18n/sentences.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { createSharedSlots } from '../../board/slots/sharedSlotsUnderTest.ts';
import { INITIAL_SERVO_VIEW } from '../../servoView.ts';
import { runByKey } from '../../../ui/action.ts';
import { PLAY_ACTIONS, STEPS } from './playActions.ts';

const frame = (durationMs: number, position: number, more: Partial<NewFrame> = {}): NewFrame => ({
  durationMs,
  targets: [{ servo: 1, position }],
  ...more,
});

const groupOf = (...frames: readonly NewFrame[]): ActionGroup =>
  frames.reduce((group, each) => insertFrame(group, group.frames.length, each), emptyGroup('Wave', 'us'));

const THEIRS: Lease = {
  ...{ driver: 'Bert', drives: false, requestedBy: null, hasRequested: false, grantedInMs: null, others: 1 },
  ...{ you: 'Ben', mayDrive: true, mayTake: false, grantedBy: null, candidates: [], unattended: null },
};

const WAVE = groupOf(frame(400, 1000), frame(400, 1600), frame(600, 1300));

async function pageWith(group: ActionGroup, board: Parameters<typeof createTestPage>[1] = {}) {
  const page = await createTestPage(new Map(), board);
  page.document.edit(
    () => 'write',
    () => group,
  );
  const phase = () => page.playback.store.getState().phase;
  const activity = () => page.device.store.getState().snapshot.activity;
  return { ...page, phase, activity };
}

describe('playing on the drawing alone', () => {
  test('goes by the clock at the chosen speed and sends nothing, also without a robot and while stopped', async () => {
    const { playback, playhead, session, draw, moves, phase } = await pageWith(WAVE);
    void session.halt();
    await draw(500);
    playback.set({ speedPercent: 50 });
    playback.togglePreview();
    await draw(1000);
    expect([phase(), playhead.at()]).toEqual(['previewing', 500]);
    playback.togglePreview();
    await draw(400);
    expect([phase(), playhead.at()]).toEqual([null, 500]);
    playback.togglePreview();
    await draw(1900);
    expect([phase(), playhead.at()]).toEqual([null, 1400]);
    await session.close();
    playback.togglePreview();
    await draw(200);
    expect([phase(), playhead.at()]).toEqual(['previewing', 100]);
    expect(moves()).toEqual([]);
  });

  test('the robot does not follow it, and Stop and a hidden page end it', async () => {
    const { playback, session, draw, moves, phase } = await pageWith(WAVE);
    playback.set({ isLive: true });
    playback.togglePreview();
    await draw(400);
    expect(playback.store.getState().isLive).toBe(false);
    expect(moves()).toEqual([]);
    void session.halt();
    await draw(20);
    expect(phase()).toBeNull();
    playback.togglePreview();
    playback.hidden();
    expect(phase()).toBeNull();
  });

  test('runs through what is marked as often as the group is run, from within it at first', async () => {
    const { playback, playhead, timeline, view, draw, phase } = await pageWith(WAVE);
    timeline.setState({ range: { fromMs: 400, toMs: 800 } });
    view.setState({ times: 2 });
    playback.togglePreview();
    await draw(500);
    expect([phase(), playhead.at()]).toEqual(['previewing', 500]);
    await draw(320);
    expect([phase(), playhead.at()]).toEqual([null, 800]);
    playback.set({ loops: true });
    playback.togglePreview();
    await draw(4100);
    expect([phase(), playhead.at()]).toEqual(['previewing', 500]);
  });
});

describe('a group made only of blocks', () => {
  const refs = WAVE.frames.map(({ id: frameId }) => ({ frameId, servo: 1 }));
  const BLOCKS = makeBlock(WAVE, refs, 'All')!;

  test('may be played, looked at, stepped through and run as any other, and an empty one is not looked at', async () => {
    const page = await pageWith(BLOCKS);
    const { playback, playhead, draw, phase, noticeTexts } = page;
    expect(BLOCKS.frames).toEqual([]);
    expect(PLAY_ACTIONS.map((action) => action.enabled(page))).toEqual(PLAY_ACTIONS.map(() => true));
    const stops = [0, 400, 1400];
    for (const at of stops.slice(1)) {
      playback.step(1);
      expect(playhead.at()).toBe(at);
    }
    playhead.go(0);
    playback.togglePreview();
    await draw(200);
    expect([phase(), playhead.at()]).toEqual(['previewing', 200]);
    playback.togglePreview();
    page.document.edit(
      () => 'clear',
      () => emptyGroup('New', 'us'),
    );
    playhead.go(0);
    playback.togglePreview();
    await draw(200);
    expect([phase(), playhead.at()]).toEqual([null, 0]);
    expect(noticeTexts()).toContain('Capture a frame first.');
  });
});

describe('playing from the page', () => {
  test('goes gently to the first pose, says so, and then moves as written; the playhead goes along', async () => {
    const { playback, playhead, phase, draw, moves } = await pageWith(WAVE);
    playback.play();
    await draw(100);
    expect(phase()).toBe('leading');
    expect(playhead.at()).toBe(400);
    await draw(1500);
    expect(phase()).toBe('playing');
    expect(playhead.at()).toBeGreaterThan(440);
    expect(playhead.at()).toBeLessThan(520);
    await draw(1200);
    expect(phase()).toBeNull();
    expect(playhead.at()).toBe(1400);
    expect(moves().map(({ durationMs, targets }) => [durationMs, targets[0]?.position])).toEqual([
      [1500, 1000],
      [400, 1600],
      [600, 1300],
    ]);
  });

  test('begins where the playhead is, and goes on from there after a pause', async () => {
    const { playback, playhead, draw, moves } = await pageWith(WAVE);
    playhead.go(600);
    playback.play();
    await draw(1600);
    playback.pause();
    await draw(200);
    expect(moves().map(({ targets }) => targets[0]?.position)).toEqual([1300, 1600]);
    const pausedAt = playhead.at();
    expect(pausedAt).toBeGreaterThan(640);
    expect(pausedAt).toBeLessThan(760);
    await draw(1000);
    expect(playhead.at()).toBe(pausedAt);
    playback.play();
    await draw(3000);
    expect(playhead.at()).toBe(1400);
  });

  test.each([50, 200])(
    'at %i percent each frame takes that much longer or shorter, to the millisecond',
    async (speedPercent) => {
      const { playback, draw, heard } = await pageWith(WAVE);
      playback.set({ speedPercent });
      playback.play();
      await draw(6000);
      const [, second, third] = heard.map(({ atMs }) => atMs);
      expect((third ?? 0) - (second ?? 0)).toBeCloseTo(40_000 / speedPercent, 6);
    },
  );

  test('in a loop it goes on until it is paused, without drift', async () => {
    const { playback, draw, heard, phase } = await pageWith(WAVE);
    playback.set({ loops: true });
    playback.play();
    await draw(1500 + 1000 + 1400 * 20 + 40);
    expect(phase()).toBe('playing');
    const arrivals = heard.map(({ atMs }) => atMs);
    const passes = arrivals.filter((_, index) => index % 3 === 0).slice(1);
    const lengths = passes.slice(1).map((atMs, index) => atMs - (passes[index] ?? 0));
    for (const length of lengths) expect(length).toBeCloseTo(1400, 6);
    playback.pause();
    await draw(100);
    expect(phase()).toBeNull();
  });

  test('a marked part that ends where it begins is looped without a seam', async () => {
    const { playback, timeline, draw, heard, phase } = await pageWith(WAVE);
    timeline.setState({ range: { fromMs: 600, toMs: 1400 } });
    playback.set({ loops: true });
    playback.play();
    const phases = new Set<unknown>();
    for (let passed = 0; passed < 10_000; passed += 100) {
      await draw(100);
      phases.add(phase());
    }
    const [, ...arrivals] = heard.map(({ atMs }) => atMs);
    const gaps = new Set(arrivals.slice(1).map((atMs, index) => Math.round(atMs - (arrivals[index] ?? 0))));
    expect(gaps).toEqual(new Set([200, 600]));
    expect(phases).toEqual(new Set(['leading', 'playing']));
  });

  test('one that ends far from there goes back gently, and says so', async () => {
    const { playback, timeline, draw, moves, phase } = await pageWith(WAVE);
    timeline.setState({ range: { fromMs: 400, toMs: 800 } });
    playback.set({ loops: true });
    playback.play();
    await draw(1500 + 400 + 200);
    expect(phase()).toBe('returning');
    await draw(1400);
    expect(phase()).toBe('playing');
    // The way back of 1.5 s leaves in two parts.
    expect(moves().map(({ durationMs }) => durationMs)).toEqual([1500, 400, 1000, 560, 400]);
  });

  test('plays as often as the group is run, from within it the rest once', async () => {
    const { playback, playhead, view, draw, moves, phase } = await pageWith(WAVE);
    view.setState({ times: 3 });
    expect(playback.next()).toEqual({ fromMs: null, times: 3 });
    playback.play();
    await draw(1500 + 1000 + 2 * 1400 + 2 * 1500 + 200);
    expect(phase()).toBeNull();
    expect(moves().filter(({ targets }) => targets[0]?.position === 1600)).toHaveLength(3);
    playhead.go(600);
    expect(playback.next()).toEqual({ fromMs: 600, times: 1 });
    playback.play();
    await draw(6000);
    expect(moves().filter(({ targets }) => targets[0]?.position === 1600)).toHaveLength(4);

    view.setState({ untilStopped: true });
    playback.play();
    await draw(20_000);
    expect(phase()).toBe('playing');
    playback.pause();
  });

  test('sends what compile says: an eased way is as near as the bound', async () => {
    const group = groupOf(frame(400, 1000), frame(1200, 2000, { easing: 'inOut' }));
    const { playback, draw, channel, compiled, document, clock, heard } = await pageWith(group);
    document.edit(
      () => 'error',
      (now) => setMeta(now, { maxErrorUnits: 8 }),
    );
    playback.play();
    await draw(1520);
    const [track] = tracksOf(group).values();
    const begunMs = heard[1]?.atMs ?? 0;
    for (let passed = 0; passed < 1150; passed += 20) {
      const wanted = positionAt(track!, 400 + clock.now() - begunMs) ?? NaN;
      // The bound, and what the servo does in the board's tick.
      expect(Math.abs(channel.board.pulse(1) - wanted)).toBeLessThanOrEqual(8 + 35);
      await draw(20);
    }
    expect(compiled.now(compileSource).frames.length).toBeGreaterThan(4);
  });

  test('muted rows are not sent, nor those beside one that plays alone; time goes on without them', async () => {
    const both = (durationMs: number, one: number, other: number): NewFrame => ({
      durationMs,
      targets: [
        { servo: 1, position: one },
        { servo: 2, position: other },
      ],
    });
    const group = groupOf(both(400, 1000, 1500), both(400, 1600, 1500), both(600, 1600, 1800));
    for (const silence of [{ muted: [2] }, { solo: [1] }]) {
      const { playback, playhead, draw, moves, ofKind, view, robots, phase } = await pageWith(group);
      view.setState({ servos: { ...INITIAL_SERVO_VIEW, robotId: robots.current().id, ...silence } });
      playback.play();
      await draw(1500 + 400 + 300);
      expect(phase()).toBe('playing');
      await draw(600);
      expect(playhead.at()).toBe(1400);
      expect(new Set(moves().flatMap(({ targets }) => targets.map(({ servo }) => servo)))).toEqual(
        new Set([1]),
      );
      playback.step(-1);
      await draw(2000);
      expect(
        moves()
          .at(-1)
          ?.targets.map(({ servo }) => servo),
      ).toEqual([1]);
      playback.runOnBoard();
      await draw(2000);
      expect(ofKind('download').map(({ frame: { targets } }) => targets.length)).toEqual([2, 2, 2]);
    }
  });

  test('a hidden page and STOP end it', async () => {
    for (const end of ['hidden', 'halt'] as const) {
      const { playback, device, draw, phase, activity } = await pageWith(WAVE);
      playback.set({ loops: true });
      playback.play();
      await draw(1800);
      if (end === 'hidden') playback.hidden();
      else device.halt();
      await draw(300);
      expect(phase()).toBeNull();
      expect(activity()).toEqual({ kind: 'idle' });
    }
  });

  test('what does not fit the robot is not begun, and a notice says which', async () => {
    const { playback, noticeTexts, draw, heard } = await pageWith(
      groupOf(frame(400, 1000), frame(400, 2600)),
    );
    playback.play();
    await draw(500);
    expect(heard).toEqual([]);
    expect(noticeTexts()[0]).toContain('Gripper in frame 2: 2600 is out of range');
  });

  test('a step goes to the next frame and back, and the robot only where it follows', async () => {
    const { playback, playhead, draw, moves } = await pageWith(WAVE);
    playback.step(1);
    playback.step(1);
    await draw(2000);
    expect(playhead.at()).toBe(800);
    expect(moves()).toEqual([]);
    playhead.go(400);
    playback.set({ isLive: true });
    await draw(2000);
    playback.step(1);
    await draw(1000);
    playback.step(-1);
    await draw(1000);
    expect(playhead.at()).toBe(400);
    expect(moves().map(({ durationMs, targets }) => [durationMs, targets[0]?.position])).toEqual([
      [1500, 1000],
      [400, 1600],
      [400, 1000],
    ]);
  });
});

describe('a step by its key', () => {
  const press = (key: string) => ({ key, ctrlKey: false, metaKey: false, shiftKey: false, altKey: false });

  test('goes from frame to frame, with the beginning as the first stop, and the time is said', async () => {
    const page = await pageWith(WAVE);
    const { playhead, notices } = page;
    const at = [];
    for (const key of ['.', '.', ',', ',', ',']) {
      expect(runByKey(STEPS, press(key), page)).toBe(true);
      at.push([playhead.at(), notices.said.getState()]);
    }
    expect(at).toEqual([
      [400, '0.40 s'],
      [800, '0.80 s'],
      [400, '0.40 s'],
      [0, '0.00 s'],
      [0, '0.00 s'],
    ]);
  });

  test('does nothing while the group plays, as its button', async () => {
    const page = await pageWith(WAVE);
    page.playback.togglePreview();
    runByKey(STEPS, press('.'), page);
    expect(page.playhead.at()).toBe(0);
    expect(STEPS.map(({ enabled }) => enabled(page))).toEqual(['Pause first.', 'Pause first.']);
  });
});

describe('the playhead', () => {
  const FAR = { fromMs: 90_000, msPerPx: 1 };

  async function pageLookingFar() {
    const page = await pageWith(WAVE);
    const lookFar = (): void => page.timeline.setState({ widthPx: 300, time: FAR });
    const fromMs = (): number => page.timeline.getState().time.fromMs;
    page.playhead.go(600);
    lookFar();
    return { ...page, lookFar, fromMs };
  }

  test('is brought into sight where playing begins; a person who looks away meanwhile is not interrupted', async () => {
    const { playback, lookFar, fromMs, draw } = await pageLookingFar();
    playback.play();
    expect(fromMs()).toBe(576);
    lookFar();
    await draw(1600);
    expect(fromMs()).toBe(FAR.fromMs);
  });

  test('is brought into sight where a preview begins', async () => {
    const { playback, fromMs } = await pageLookingFar();
    playback.togglePreview();
    expect(fromMs()).toBe(576);
  });

  test('is brought into sight by a step', async () => {
    const { playback, fromMs } = await pageLookingFar();
    playback.step(-1);
    expect(fromMs()).toBe(376);
  });

  test('is brought into sight when the board begins', async () => {
    const { playback, fromMs, draw } = await pageLookingFar();
    playback.runOnBoard();
    await draw(800);
    expect(fromMs()).toBe(-24);
  });
});

describe('the robot that follows', () => {
  test('goes gently to the pose at the playhead, then along with it and with each edit', async () => {
    const { playback, playhead, document, draw, moves, channel } = await pageWith(WAVE);
    playhead.go(400);
    playback.set({ isLive: true });
    await draw(1700);
    expect(moves()[0]).toMatchObject({ durationMs: 1500, targets: [{ servo: 1, position: 1000 }] });
    playhead.go(800);
    await draw(700);
    expect(channel.board.target(1)).toBe(1600);
    document.edit(
      () => 'change',
      () => groupOf(frame(400, 1000), frame(400, 1700)),
    );
    await draw(500);
    expect(channel.board.target(1)).toBe(1700);
    document.undo();
    await draw(500);
    expect(channel.board.target(1)).toBe(1600);
  });

  test('moves nothing once STOP was pressed, and not again after Resume', async () => {
    const { playback, playhead, device, draw, moves } = await pageWith(WAVE);
    playback.set({ isLive: true });
    playhead.go(400);
    await draw(1700);
    device.halt();
    await draw(500);
    const before = moves().length;
    device.resume();
    await draw(100);
    playhead.go(800);
    await draw(500);
    expect(moves().length).toBe(before);
    expect(playback.store.getState().isLive).toBe(false);
  });
});

describe('a robot that follows where another client takes it over', () => {
  test.each(['playback', 'blend', 'macroRun'] as const)(
    'does so no longer, and not again: %s',
    async (which) => {
      const { playback, playhead, blend, macroRun, device, draw, moves } = await pageWith(WAVE);
      const isOn = (): boolean =>
        which === 'macroRun'
          ? macroRun.store.getState() !== null
          : { playback, blend }[which].store.getState().isLive;
      playback.set({ isLive: which === 'playback' });
      blend.show([{ servo: 1, position: 1200 }]);
      blend.follow(which === 'blend');
      if (which === 'macroRun')
        macroRun.start({
          ...{ id: 1, name: 'Wait', colour: 'slate', key: null },
          steps: [{ kind: 'wait', waitMs: 9000 }],
        });
      await draw(1700);
      expect(isOn()).toBe(true);
      const { snapshot } = device.store.getState();
      device.store.setState({ snapshot: { ...snapshot, lease: THEIRS } });
      expect(isOn()).toBe(false);
      device.store.setState({ snapshot });
      const before = moves().length;
      playhead.go(800);
      blend.show([{ servo: 1, position: 1800 }]);
      await draw(1000);
      expect(moves().length).toBe(before);
    },
  );
});

describe('playing on the board', () => {
  test('downloads first where the board has not just this, then runs; the playhead follows the clock', async () => {
    const { playback, playhead, phase, draw, ofKind } = await pageWith(WAVE);
    playback.runOnBoard();
    await draw(40);
    expect(phase()).toBe('storing');
    await draw(600);
    expect(phase()).toBe('running');
    expect(ofKind('download').length).toBe(3);
    expect(ofKind('run')).toEqual([{ kind: 'run', slot: 21, times: 1 }]);
    await draw(400);
    expect(playhead.at()).toBeGreaterThan(200);
    await draw(1600);
    expect(phase()).toBeNull();
    expect(playhead.at()).toBe(1400);

    playback.runOnBoard();
    await draw(100);
    expect(ofKind('download').length).toBe(3);
    expect(ofKind('run').length).toBe(2);
  });

  test('goes to the slot and runs as often as was chosen', async () => {
    const { playback, view, draw, ofKind } = await pageWith(WAVE);
    view.setState({ slot: 7, times: 3 });
    playback.runOnBoard();
    await draw(1000);
    expect(ofKind('run')).toEqual([{ kind: 'run', slot: 7, times: 3 }]);
  });

  test('downloads again after an edit', async () => {
    const { playback, document, draw, ofKind } = await pageWith(WAVE);
    playback.runOnBoard();
    await draw(3000);
    document.edit(
      () => 'change',
      () => groupOf(frame(400, 1000), frame(400, 1700)),
    );
    playback.runOnBoard();
    await draw(3000);
    expect(ofKind('download').length).toBe(5);
    expect(ofKind('run').length).toBe(2);
  });

  test('a download that is called off runs nothing', async () => {
    const { playback, draw, ofKind, phase, noticeTexts } = await pageWith(WAVE);
    playback.runOnBoard();
    await draw(40);
    playback.pause();
    await draw(1000);
    expect(phase()).toBeNull();
    expect(ofKind('run')).toEqual([]);
    expect(noticeTexts()).toEqual([downloadCancelled(21)]);
  });

  describe('where the slot holds another group', () => {
    /** The first group is in slot 21, the second one, now open, is to go there. */
    async function pageWithAnother(name: string, board: Parameters<typeof createTestPage>[1] = {}) {
      const page = await pageWith(WAVE, board);
      const { playback, document, opened, view, replacing, ofKind, draw } = page;
      playback.runOnBoard();
      await draw(3000);
      opened.setState({ openId: 'another' });
      document.take(startHistory({ ...groupOf(frame(400, 1200)), name }));
      view.setState({ slot: 21 });
      const counts = () => [ofKind('download').length, ofKind('run').length];
      const requested = () => replacing.store.getState().question?.conflicts[0] ?? null;
      return { ...page, counts, requested };
    }

    for (const name of ['Bow', 'Wave'])
      test(`asks before “${name}” takes the place of “Wave”`, async () => {
        const { playback, replacing, draw, counts, requested } = await pageWithAnother(name);
        playback.runOnBoard();
        await draw(1000);
        expect(requested()).toMatchObject({ name, record: { slot: 21, name: 'Wave' } });
        expect(counts()).toEqual([3, 1]);
        replacing.answer('leave');
        await draw(1000);
        expect([requested(), counts()]).toEqual([null, [3, 1]]);
        playback.runOnBoard();
        replacing.answer('replace');
        await draw(2000);
        expect([requested(), counts()]).toEqual([null, [4, 2]]);
        playback.runOnBoard();
        await draw(1000);
        expect([requested(), counts()]).toEqual([null, [4, 3]]);
      });

    test('asks again where the slot got still another one meanwhile', async () => {
      const { playback, replacing, slots, draw, counts, requested } = await pageWithAnother('Bow');
      playback.runOnBoard();
      slots.download([{ slot: 21, name: 'Third', documentId: 'third', frames: [frame(500, 1300)] }]);
      await draw(2000);
      replacing.answer('replace');
      await draw(1000);
      expect(requested()).toMatchObject({ record: { name: 'Third' } });
      expect(counts()).toEqual([4, 1]);
    });

    test('asks again where another client has stored something there meanwhile, and before', async () => {
      const { share, othersStore, requested: stored } = createSharedSlots();
      const { device, playback, replacing, draw, requested, phase } = await pageWithAnother('Bow', { share });
      // A board that holds nothing never says that a run is over.
      device.stopGroup();
      await draw(1000);
      expect(phase()).toBeNull();
      playback.runOnBoard();
      expect(requested()).toMatchObject({ slot: 21, record: { name: 'Wave' } });
      othersStore(21, { version: 'of Bert', name: 'Nod' });
      replacing.answer('replace');
      await draw(1000);
      expect(requested()).toMatchObject({ slot: 21, record: null, version: 'of Bert', held: 'Nod' });
      expect(stored).toHaveLength(1);
      replacing.answer('replace');
      await draw(1000);
      expect(requested()).toBeNull();
      expect(stored.map(({ replaces }) => replaces)).toEqual(['', 'of Bert']);
    });

    test('of which an earlier version noted the name alone, it asks too', async () => {
      const { playback, slots, draw, requested } = await pageWithAnother('Wave');
      slots.store.setState(({ book }) => ({
        book: { ...book, stored: book.stored.map((record) => ({ ...record, documentId: null })) },
      }));
      playback.runOnBoard();
      await draw(1000);
      expect(requested()).not.toBeNull();
    });
  });
});
