import { describe, expect, test, vi } from 'vitest';
import type { Robot } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import { createRig } from '#shared/robot/rig.ts';
import type { SessionEvents } from '#shared/robot/state.ts';
import { downloadedSentence, downloadCancelled, errorSentence } from '../i18n/sentences.ts';
import { words } from '../i18n/words.ts';
import { createDevice } from './device.ts';
import { createNotices } from '../state/notices.ts';
import { createRobots } from '../features/profiles/robots.ts';

const FRAMES = [900, 1500, 2100].map((position) => ({
  durationMs: 400,
  targets: [{ servo: 1, position }],
}));

/** `listening` gets what the device hears of its session with. */
async function createTestPage(listening: (events: SessionEvents) => unknown = () => undefined) {
  const rig = await createRig();
  const session = new Proxy(rig.session, {
    get: (target, key) => {
      if (key !== 'subscribe') return Reflect.get(target, key) as unknown;
      return (events: SessionEvents) => {
        listening(events);
        return target.subscribe(events);
      };
    },
  });
  const notices = createNotices(rig.clock);
  const robots = createRobots({ getItem: () => null, setItem: () => undefined }, notices);
  const device = createDevice({ family: FAMILIES.doc, clock: rig.clock, notices, robots });
  device.attach(session, { kind: 'simulated', label: 'Simulated board', isSimulated: true });
  const state = () => device.store.getState();
  const targets = () => Object.fromEntries(device.pose().map(({ servo, position }) => [servo, position]));
  const noticeTexts = () => notices.store.getState().map((notice) => notice.text);
  /** Time passes with the page being drawn, as it is in a browser. */
  async function draw(ms: number) {
    for (let passed = 0; passed < ms; passed += 20) {
      await rig.clock.advance(20);
      device.refresh();
    }
  }
  return { ...rig, robots, notices, device, state, targets, noticeTexts, draw };
}

describe('what playing could not keep', () => {
  const MANY = Array.from({ length: 55 }, (_, index) => ({
    durationMs: 40,
    targets: [{ servo: 1, position: 1000 + 10 * (index % 20) }],
  }));

  test('frames that began late are reported, with how late, and that none was left out', async () => {
    const { device, asleep, draw, noticeTexts } = await createTestPage();
    device.play(MANY, 1, () => undefined);
    await draw(1900);
    await asleep(300);
    await draw(6000);
    expect(noticeTexts()).toEqual([
      expect.stringMatching(/^This page was busy while it played: .* began late, by up to 2\d\d ms\. None/),
    ]);
  });

  test('a frame that was left out is reported instead', async () => {
    const { device, channel, asleep, draw, noticeTexts } = await createTestPage();
    const { write } = channel;
    let sent = 0;
    channel.write = (packet) =>
      ++sent === 2 ? Promise.reject(new LinkError('expired', 'too late')) : write(packet);
    device.play(MANY, 1, () => undefined);
    await draw(1900);
    await asleep(300);
    await draw(6000);
    expect(noticeTexts()).toContain(words.play.skipped({ frames: 1 }));
    expect(noticeTexts()).not.toContainEqual(expect.stringContaining('None was left out'));
  });

  test('nothing is reported of what went well', async () => {
    const { device, draw, noticeTexts } = await createTestPage();
    device.play(MANY, 1, () => undefined);
    await draw(6000);
    expect(noticeTexts()).toEqual([]);
  });
});

describe('what came too late', () => {
  const late = errorSentence('expired');

  async function latePage() {
    let events: SessionEvents | undefined;
    const page = await createTestPage((heard) => (events = heard));
    const refuse = (code: LinkErrorCode): void => events?.problem(new LinkError(code, ''));
    return { ...page, refuse, again: () => page.device.move([{ servo: 1, position: 1600 }], 500) };
  }

  test('is reported until it was asked for again and went well for a while', async () => {
    const { refuse, again, noticeTexts, draw } = await latePage();
    refuse('expired');
    await draw(20_000);
    expect(noticeTexts()).toEqual([late]);
    again();
    await draw(2900);
    expect(noticeTexts()).toEqual([late]);
    await draw(200);
    expect(noticeTexts()).toEqual([]);
  });

  test('stays where it happens again meanwhile', async () => {
    const { refuse, again, noticeTexts, draw } = await latePage();
    for (let time = 0; time < 5; time += 1) {
      refuse('expired');
      again();
      await draw(1000);
    }
    refuse('overslept');
    await draw(5000);
    expect(noticeTexts()).toEqual([late, errorSentence('overslept')]);
    again();
    await draw(3100);
    expect(noticeTexts()).toEqual([]);
  });

  test('takes no other message away', async () => {
    const { refuse, again, noticeTexts, draw } = await latePage();
    refuse('noAnswer');
    again();
    await draw(5000);
    expect(noticeTexts()).toEqual([errorSentence('noAnswer')]);
  });
});

describe('a device with a session', () => {
  test('shows what was asked for at once and never the value before it again', async () => {
    const { device, clock, targets } = await createTestPage();
    device.move([{ servo: 3, position: 1700 }], 500);
    expect(targets()[3]).toBe(1700);
    for (let step = 0; step < 40; step++) {
      await clock.advance(5);
      device.refresh();
      expect(targets()).toEqual({ 3: 1700 });
    }
  });

  test('sends a drag at once, and the store has what comes of it with the next frame', async () => {
    const { device, state, targets, clock, channel } = await createTestPage();
    device.drag([{ servo: 3, position: 1700 }], 500);
    expect(targets()).toEqual({ 3: 1700 });
    expect(state().known).toEqual([]);
    await clock.advance(15);
    expect(channel.board.target(3)).toBe(1700);
    device.refresh();
    expect(state().known).toEqual([3]);
  });

  test('moves from the first packet until the servo is there, and a stream of drags is one motion', async () => {
    const { device, state, draw } = await createTestPage();
    device.move([{ servo: 3, position: 1700 }], 500);
    await draw(2000);
    device.move([{ servo: 3, position: 1600 }], 500);
    await draw(200);
    expect(state().isMoving).toBe(true);
    for (const position of [1610, 1620, 1630]) {
      device.drag([{ servo: 3, position }], 100);
      await draw(400);
      expect(state().isMoving).toBe(true);
    }
    await draw(1500);
    expect(state().isMoving).toBe(false);
    await device.detach();
    expect(state().isMoving).toBe(false);
  });

  test('counts the servos whose newest target has not left yet', async () => {
    const { device, draw } = await createTestPage();
    device.move(
      [1, 2].map((servo) => ({ servo, position: 1600 })),
      300,
    );
    expect(device.waiting()).toBe(2);
    await draw(200);
    expect(device.waiting()).toBe(1);
    await draw(200);
    expect(device.waiting()).toBe(0);
  });

  test('shows what was asked of a servo for as long as it waits for its first move', async () => {
    const { device, state, draw, targets } = await createTestPage();
    device.move(
      [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 1600 })),
      300,
    );
    for (let step = 0; step < 100; step++) {
      await draw(20);
      expect(targets()[6]).toBe(1600);
    }
    expect(state().snapshot.waitingToStart).toEqual([]);
  });

  test('knows nothing of a servo that was not moved', async () => {
    const { device, targets } = await createTestPage();
    expect(targets()).toEqual({});
    expect(device.motion(1)).toEqual({ target: null, estimated: null });
  });

  test('wakes no listener while a drag goes on', async () => {
    const { device, draw } = await createTestPage();
    const woken = vi.fn();
    async function dragTo(from: number, to: number) {
      for (let position = from; position < to; position += 10) {
        device.drag([{ servo: 1, position }], 'hand');
        await draw(20);
      }
    }
    device.move([{ servo: 1, position: 1000 }], 300);
    await draw(2500);
    await dragTo(1000, 1300);
    device.store.subscribe(woken);
    await dragTo(1300, 1900);
    expect(woken).not.toHaveBeenCalled();
  });

  test('drops what was only wished for when STOP comes first', async () => {
    const { device, state, draw, targets } = await createTestPage();
    device.move([{ servo: 1, position: 1600 }], 300);
    await draw(2500);
    device.move([{ servo: 1, position: 2400 }], 3000);
    device.halt();
    await draw(500);
    expect(state().snapshot.latch).toMatchObject({ reason: 'pressed' });
    expect(targets()[1]).toBeLessThan(2400);
  });

  test('refuses to move while stopped and says so; Resume moves nothing', async () => {
    const { device, state, noticeTexts, draw, ofKind } = await createTestPage();
    device.halt();
    await draw(400);
    device.move([{ servo: 1, position: 2400 }], 300);
    expect(noticeTexts()).toEqual([errorSentence('latched')]);
    const movesBefore = ofKind('move').length;
    device.resume();
    await draw(400);
    expect(state().snapshot.latch).toBeNull();
    expect(ofKind('move')).toHaveLength(movesBefore);
  });

  test('tells the name and the range of a servo that shall not go there, and keeps the target', async () => {
    const { device, noticeTexts, targets } = await createTestPage();
    device.move([{ servo: 1, position: 2600 }], 300);
    expect(noticeTexts()[0]).toContain('Gripper: 2600 is out of range');
    expect(targets()).toEqual({});
  });

  test('of a hand that goes on beyond a limit the latest word stands, until the servo goes elsewhere', async () => {
    const { device, noticeTexts } = await createTestPage();
    for (const position of [2600, 2610, 2620]) device.move([{ servo: 1, position }], 'hand');
    expect(noticeTexts()).toEqual([expect.stringContaining('Gripper: 2620 is out of range')]);
    device.move([{ servo: 2, position: 1500 }], 300);
    expect(noticeTexts()).toHaveLength(1);
    device.move([{ servo: 1, position: 1500 }], 300);
    expect(noticeTexts()).toEqual([]);
  });

  describe('with a robot of its own limits and trim', () => {
    const elbow = (robot: Robot): Robot => ({
      ...robot,
      servos: robot.servos.map((servo) =>
        servo.servo === 4 ? { ...servo, min: 700, max: 2300, trim: 40 } : servo,
      ),
    });

    async function createElbowPage() {
      const page = await createTestPage();
      page.robots.edit(() => 'limits', elbow);
      return page;
    }

    test('the board gets the trim on top; the page goes on in what was meant', async () => {
      const { device, draw, ofKind, targets } = await createElbowPage();
      device.move([{ servo: 4, position: 1000 }], 0);
      await draw(2000);
      expect(ofKind('move')[0]?.targets).toEqual([{ servo: 4, position: 1040 }]);
      expect(targets()).toEqual({ 4: 1000 });
      expect(device.motion(4)).toEqual({ target: 1000, estimated: 1000 });
    });

    test('only the servo that is calibrated jogs past its limits, as far as the board goes', async () => {
      const { device, noticeTexts, draw, ofKind, targets } = await createElbowPage();
      device.jog(2400, 100);
      device.calibrate(4);
      device.jog(2400, 100);
      await draw(2000);
      device.move([{ servo: 4, position: 2400 }], 0);
      device.jog(2480, 100);
      device.calibrate(null);
      device.jog(2410, 100);
      await draw(2000);
      expect(ofKind('move').map(({ targets }) => targets)).toEqual([[{ servo: 4, position: 2440 }]]);
      expect(targets()).toEqual({ 4: 2400 });
      expect(noticeTexts()).toEqual([
        expect.stringContaining('Elbow: 2400 is out of range'),
        expect.stringContaining('2520'),
      ]);
    });

    test('a group with one pose outside is neither played nor downloaded', async () => {
      const { device, noticeTexts, draw, heard } = await createElbowPage();
      const frames = [900, 2400].map((position) => ({ durationMs: 300, targets: [{ servo: 4, position }] }));
      device.play(frames, 1, () => undefined);
      device.download([{ slot: 3, frames }]);
      await draw(2000);
      expect(noticeTexts()[0]).toContain('Elbow: 2400 is out of range; it takes 700');
      expect(heard).toEqual([]);
    });
  });

  test('stores a group and tells when it is done', async () => {
    const { device, state, noticeTexts, draw, channel } = await createTestPage();
    device.download([{ slot: 5, frames: FRAMES }]);
    await draw(60);
    expect(state().snapshot.activity).toMatchObject({ kind: 'downloading', slot: 5, frameCount: 3 });
    await draw(4000);
    expect(state().snapshot.storedSlots).toEqual([5]);
    expect(channel.board.frameCount(5)).toBe(3);
    expect(noticeTexts()).toEqual([downloadedSentence([5])]);
  });

  test('says whether a download came to its end', async () => {
    const { device, draw } = await createTestPage();
    const heard: boolean[] = [];
    device.download([{ slot: 5, frames: FRAMES }], (isDone) => void heard.push(isDone));
    await draw(4000);
    device.download([{ slot: 6, frames: FRAMES }], (isDone) => void heard.push(isDone));
    await draw(100);
    device.cancelDownload();
    await draw(4000);
    expect(heard).toEqual([true, false]);
  });

  test('a cancelled download leaves a broken slot and says so', async () => {
    const { device, state, noticeTexts, draw } = await createTestPage();
    device.download([{ slot: 5, frames: Array.from({ length: 60 }, () => FRAMES[0]!) }]);
    await draw(400);
    device.cancelDownload();
    await draw(4000);
    expect(state().snapshot.brokenSlots).toEqual([5]);
    expect(noticeTexts()).toEqual([downloadCancelled(5)]);
  });

  test('playing to the end is reported, pausing is not', async () => {
    const { device, state, draw, targets } = await createTestPage();
    let finished = 0;
    device.play(FRAMES, 1, (isDone) => (finished += Number(isDone)));
    await draw(1600);
    expect(state().snapshot.activity).toMatchObject({ kind: 'playing', frameIndex: 1 });
    device.stopPlaying();
    await draw(2000);
    expect(finished).toBe(0);
    device.play(FRAMES, 1, (isDone) => (finished += Number(isDone)));
    await draw(4000);
    expect(finished).toBe(1);
    expect(targets()[1]).toBe(2100);
  });

  test('playing that STOP ended was not played to the end', async () => {
    const { device, draw } = await createTestPage();
    const heard: boolean[] = [];
    device.play(FRAMES, 0, (isDone) => void heard.push(isDone));
    await draw(6000);
    expect(heard).toEqual([]);
    device.halt();
    await draw(500);
    expect(heard).toEqual([false]);
  });

  test('a lost link keeps no position and comes back latched', async () => {
    const { device, state, draw, channel, targets } = await createTestPage();
    device.move([{ servo: 1, position: 1600 }], 300);
    await draw(2500);
    channel.unplug();
    await draw(100);
    expect(state().snapshot.link).toMatchObject({ status: 'lost' });
    expect(targets()).toEqual({});
    channel.plugIn();
    await draw(6000);
    expect(state().snapshot.link.status).toBe('ready');
    expect(state().snapshot.latch).toMatchObject({ reason: 'reconnected' });
  });

  test('that another program had the port is not said any more once the robot is ready', async () => {
    const { notices, noticeTexts, draw, channel } = await createTestPage();
    channel.unplug();
    await draw(100);
    notices.showError(new LinkError('portBusy', '', { heldBy: ['minicom (7)'] }));
    notices.showError(new LinkError('noAnswer', ''));
    channel.plugIn();
    await draw(6000);
    expect(noticeTexts()).toEqual([errorSentence('noAnswer')]);
  });

  test('that the robot may move again is not said any more once it is stopped again', async () => {
    let resumed: SessionEvents['resumed'] = () => undefined;
    const { device, noticeTexts, draw } = await createTestPage((events) => (resumed = events.resumed));
    resumed('Anna');
    expect(noticeTexts()).toEqual([words.stop.resumed({ name: 'Anna' })]);
    device.halt();
    await draw(400);
    expect(noticeTexts()).toEqual([]);
  });

  test('logs each packet and what becomes of the link, once and in order', async () => {
    const { device, draw, channel } = await createTestPage();
    device.move([{ servo: 1, position: 1700 }], 0);
    await draw(200);
    device.halt();
    await draw(150);
    device.resume();
    await draw(100);
    channel.unplug();
    await draw(100);
    await device.detach();
    const { entries } = device.traffic.content('doc');
    const marks = entries.map((entry) => (entry.mark === 'link' ? entry.happening : entry.mark));
    // Three stops, and a first row of those that go on until Resume.
    const stop = ['stopped', 'sent', 'sent', 'sent', 'sent'];
    expect(marks).toEqual(['opened', 'sent', ...stop, 'resumed', 'lost', 'latched', 'closed']);
    const { oldestId, nextId } = device.traffic.store.getState();
    expect(nextId - oldestId).toBe(entries.length);
  });

  test('logs that the link is ready before what is sent because of it', async () => {
    const { device, draw, session } = await createTestPage();
    await device.detach();
    device.traffic.clear();
    device.store.subscribe(({ snapshot }, before) => {
      if (snapshot.link.status === 'ready' && before.snapshot.link.status !== 'ready') device.readBattery();
    });
    device.attach(session, { kind: 'simulated', label: 'Simulated board', isSimulated: true });
    void session.open();
    await draw(200);
    expect(device.traffic.content('doc').entries.map(({ mark }) => mark)).toEqual([
      'link',
      'sent',
      'received',
    ]);
  });

  test('sends a packet by hand, or tells why not', async () => {
    const { device, draw, ofKind, noticeTexts } = await createTestPage();
    device.sendRaw(Uint8Array.of(0x55, 0x55, 2, 15));
    device.sendRaw(Uint8Array.of(0x55, 0x55, 2, 6));
    await draw(500);
    expect(ofKind('readBattery')).toHaveLength(1);
    expect(noticeTexts()).toEqual([errorSentence('outOfRange', 'packet by hand: otherShape')]);
  });

  test('detached, it is as if nothing had ever been connected', async () => {
    const { device, state, session } = await createTestPage();
    await device.detach();
    expect(state().way).toBeNull();
    expect(state().snapshot.link.status).toBe('closed');
    expect(session.state.link.status).toBe('closed');
  });
});
