import { describe, expect, test } from 'vitest';
import { step, type TipDriver } from '#shared/profile/mappingStep.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { Input, Tilt } from '#shared/profile/mapping.ts';
import { addPose } from '#shared/profile/pose.ts';
import { createRig } from '#shared/robot/rig.ts';
import { stayingSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import { createDevice } from '../../robot/device.ts';
import { createMappings, createPad, type Gamepadlike } from './pad.ts';
import { choosingTip } from './rows.ts';
import { createNotices } from '../../state/notices.ts';
import { createPoses } from '../poses/poses.ts';
import { createView } from '../view.ts';
import { INITIAL_SERVO_VIEW } from '../servoView.ts';
import { createRobots, freshRobot } from '../profiles/robots.ts';

const STANDARD = { id: 'Pad', index: 0, mapping: 'standard' };
/** Button numbers of the ready mapping. */
const STOP = 1;
const RIGHT_TRIGGER = 7;

/** A robot whose first servo stands at 1500, and a pad lying beside it, switched on unless said otherwise. */
async function createTestPage({ drives = true } = {}) {
  const rig = await createRig();
  const notices = createNotices(rig.clock);
  const storage = { getItem: () => null, setItem: () => undefined };
  const robots = createRobots(storage, notices);
  const device = createDevice({ family: FAMILIES.doc, clock: rig.clock, notices, robots });
  const mappings = createMappings(storage, notices, robots);
  let plugged: Gamepadlike | null = null;
  const readPads = () => [null, plugged];
  const view = createView({ browser: storage, tab: storage });
  const poses = createPoses({ storage, notices, robots, device, view });
  const pad = createPad({ device, robots, view, poses, mappings, notices, clock: rig.clock, readPads });
  device.attach(rig.session, { kind: 'simulated', label: 'Simulated board', isSimulated: true });
  const noticeTexts = () => notices.store.getState().map((notice) => notice.text);
  const moves = () => rig.ofKind('move').length;
  const target = (servo = 1) => device.motion(servo).target ?? undefined;

  function hold(...pressed: readonly number[]): void {
    push([0, 0, 0, 0], pressed);
  }
  function push(axes: readonly number[], pressed: readonly number[] = []): void {
    const value = (button: number) => ({ value: pressed.includes(button) ? 1 : 0 });
    plugged = { ...STANDARD, axes, buttons: Array.from({ length: 17 }, (_, at) => value(at)) };
  }
  async function frames(ms: number): Promise<void> {
    for (let passed = 0; passed < ms; passed += 16) {
      await rig.clock.advance(16);
      device.refresh();
      pad.frame();
    }
  }

  /** What leaves during a while, once what is on its way has left. */
  async function movesIn(ms: number): Promise<number> {
    await frames(100);
    const before = moves();
    await frames(ms);
    return moves() - before;
  }

  hold();
  device.move([{ servo: 1, position: 1500 }], 1500);
  await frames(2500);
  if (drives) pad.drive(step);
  await frames(50);
  return {
    ...{
      ...rig,
      pad,
      device,
      robots,
      view,
      poses,
      mappings,
      noticeTexts,
      moves,
      movesIn,
      target,
      hold,
      push,
      frames,
    },
    isDriving: () => pad.store.getState().isDriving,
    unplug: () => (plugged = null),
  };
}

describe('driving by pad', () => {
  test('a trigger turns its servo while it is held, and not a moment longer', async () => {
    const { hold, frames, target, device, movesIn } = await createTestPage();
    hold(RIGHT_TRIGGER);
    await frames(500);
    const reached = target() ?? 0;
    expect(reached).toBeGreaterThan(1700);
    hold();
    await frames(300);
    expect((target() ?? 0) - reached).toBeLessThan(20);
    expect(device.motion(1).estimated).toBe(target());
    expect(await movesIn(500)).toBe(0);
  });

  test('off, nothing moves: neither connecting a pad nor pushing it', async () => {
    const { hold, unplug, frames, movesIn } = await createTestPage({ drives: false });
    unplug();
    await frames(50);
    hold(RIGHT_TRIGGER);
    expect(await movesIn(500)).toBe(0);
  });

  test('a pad that comes with a trigger held moves nothing until it is let go', async () => {
    const { hold, unplug, frames, pad, movesIn } = await createTestPage();
    unplug();
    await frames(50);
    pad.drive(step);
    await frames(50);
    hold(RIGHT_TRIGGER);
    expect(await movesIn(500)).toBe(0);
    hold();
    await frames(50);
    hold(RIGHT_TRIGGER);
    expect(await movesIn(500)).toBeGreaterThan(0);
  });

  test('pulling the pad ends the motion, switches off and says so', async () => {
    const { hold, unplug, frames, isDriving, noticeTexts, movesIn } = await createTestPage();
    hold(RIGHT_TRIGGER);
    await frames(200);
    unplug();
    await frames(50);
    expect(isDriving()).toBe(false);
    expect(noticeTexts()).toEqual([words.pad.gone]);
    expect(await movesIn(300)).toBe(0);
  });

  test('a servo that was not moved stays and is asked for; once it is known it turns', async () => {
    const { hold, frames, device, noticeTexts, target, movesIn } = await createTestPage();
    hold(5);
    expect(await movesIn(300)).toBe(0);
    expect(noticeTexts()).toEqual([words.pad.unknown({ servo: 'Wrist roll' })]);
    hold();
    device.move([{ servo: 2, position: 1500 }], 1500);
    await frames(4000);
    hold(5);
    await frames(500);
    expect(target(2)).toBeGreaterThan(1600);
  });

  test('other robot, other hands: taking up another one switches off', async () => {
    const { robots, isDriving } = await createTestPage();
    robots.add(() => 'add', freshRobot('hand', 'doc'));
    expect(isDriving()).toBe(false);
  });
});

test('a servo that is pushed on at its limit is reported once while driving goes on, with its range', async () => {
  const { hold, frames, noticeTexts, target, movesIn } = await createTestPage();
  const push = async (): Promise<void> => {
    hold(RIGHT_TRIGGER);
    await frames(4000);
  };
  await push();
  expect(target()).toBe(2500);
  expect(noticeTexts()).toEqual([words.pad.atLimit({ servo: 'Gripper', min: 500, max: 2500 })]);
  expect(await movesIn(500)).toBe(0);
  hold();
  await frames(8000);
  await push();
  expect(noticeTexts()).toEqual([]);
});

test('a locked servo stays, is reported once a push, and turns once it is free', async () => {
  const { hold, frames, view, robots, noticeTexts, target, movesIn } = await createTestPage();
  const lock = (...locked: readonly number[]): void =>
    view.setState({ servos: { ...INITIAL_SERVO_VIEW, robotId: robots.current().id, locked } });
  lock(1);
  hold(RIGHT_TRIGGER);
  expect(await movesIn(500)).toBe(0);
  expect(noticeTexts()).toEqual([stayingSentence(['Gripper'])]);
  lock();
  hold();
  await frames(50);
  hold(RIGHT_TRIGGER);
  await frames(300);
  expect(target()).toBeGreaterThan(1600);
});

describe('a button for a pose', () => {
  const X = 2;

  async function pageWithPose() {
    const page = await createTestPage();
    page.poses.book.edit(
      () => 'capture',
      (book) => addPose(book, { name: 'Wave', unit: 'us', targets: [{ servo: 1, position: 1900 }] }),
    );
    page.mappings.edit(
      () => 'bind',
      (mapping) => ({
        ...mapping,
        bindings: [
          ...mapping.bindings,
          { input: { kind: 'button', index: X }, action: { kind: 'pose', pose: 1, durationMs: 2500 } },
        ],
      }),
    );
    await page.frames(50);
    return page;
  }

  test('goes there once a press, in the time that was chosen, and on when it is let go', async () => {
    const { hold, frames, ofKind, target, poses, movesIn } = await pageWithPose();
    hold(X);
    await frames(500);
    // The first of 2.5 s.
    expect(ofKind('move').at(-1)).toMatchObject({
      durationMs: 1000,
      targets: [{ servo: 1, position: 1660 }],
    });
    expect(poses.book.store.getState().present.applied).toBe(1);
    hold();
    expect(target()).toBe(1900);
    await frames(2500);
    expect(ofKind('move').at(-1)?.targets).toEqual([{ servo: 1, position: 1900 }]);
    expect(await movesIn(500)).toBe(0);
  });

  test('moves nothing while driving is off, and says where the pose is gone', async () => {
    const { hold, frames, pad, poses, noticeTexts, movesIn } = await pageWithPose();
    pad.drive(null);
    hold(X);
    expect(await movesIn(300)).toBe(0);
    hold();
    poses.book.undo();
    pad.drive(step);
    await frames(50);
    hold(X);
    expect(await movesIn(300)).toBe(0);
    expect(noticeTexts()).toEqual([words.poses.gone]);
  });
});

test('a tilt moves its servo while it counts, and nothing once it does not', async () => {
  const { pad, mappings, frames, target, movesIn } = await createTestPage();
  mappings.edit(
    () => 'bind',
    (mapping) => ({
      ...mapping,
      bindings: [
        {
          input: { kind: 'tilt', axis: 'forward', side: 'whole' },
          action: { kind: 'rate', servo: 1, unitsPerS: 800 },
        },
      ],
    }),
  );
  let tilt: Tilt | null = null;
  pad.tiltBy(() => tilt);
  expect(await movesIn(300)).toBe(0);
  tilt = { sideways: 1, forward: 0.6 };
  await frames(500);
  expect(target()).toBeGreaterThan(1600);
  tilt = null;
  await frames(50);
  expect(await movesIn(500)).toBe(0);
});

describe('the end of a limb', () => {
  /** Of a limb that is one servo: a unit a millimetre. */
  async function pageWithTip() {
    const page = await createTestPage({ drives: false });
    const { robots, device, pad, mappings } = page;
    const driver: TipDriver = {
      ...{ robot: robots.current().robot, tip: 'grip', servos: [1] },
      step(speed, dtMs) {
        const at = device.motion(1).target;
        if (speed === null || at === null) return { moves: [], unknown: [], isShort: false };
        const position = Math.round(at + (speed[0] * dtMs) / 1000);
        return { moves: [{ servo: 1, position }], unknown: [], isShort: position > 1600 };
      },
    };
    mappings.edit(
      () => 'tip',
      (mapping) => choosingTip(mapping, robots.current().robot, true),
    );
    pad.lead(driver);
    pad.drive(step);
    await page.frames(50);
    return { ...page, driver, limb: () => pad.store.getState().limb };
  }

  test('follows the left stick, and stops when it is released', async () => {
    const { push, frames, target, movesIn } = await pageWithTip();
    push([0, -1, 0, 0]);
    await frames(1000);
    expect(target()).toBeGreaterThan(1550);
    push([0, 0, 0, 0]);
    await frames(50);
    expect(await movesIn(500)).toBe(0);
  });

  test('stays in the dead zone, and while driving is off', async () => {
    const { push, pad, movesIn } = await pageWithTip();
    push([0.1, -0.1, 0, 0.1]);
    expect(await movesIn(300)).toBe(0);
    pad.drive(null);
    push([0, -1, 0, 0]);
    expect(await movesIn(300)).toBe(0);
  });

  test('is reported where it cannot go on, until it is released', async () => {
    const { push, frames, limb } = await pageWithTip();
    push([0, -1, 0, 0]);
    await frames(2500);
    expect(limb()).toEqual({ tip: 'grip', servos: [1], isShort: true });
    push([0, 0, 0, 0]);
    await frames(100);
    expect(limb()).toMatchObject({ isShort: false });
  });

  test('another profile ends driving: its joints are not the same', async () => {
    const { robots, isDriving, limb } = await pageWithTip();
    robots.edit(
      () => 'rename',
      (robot) => ({ ...robot, name: 'Other' }),
    );
    expect(isDriving()).toBe(false);
    expect(limb()).toBeNull();
  });
});

describe('STOP', () => {
  test('on the pad halts and switches off; resuming does not switch on', async () => {
    const { hold, frames, device, isDriving, ofKind, movesIn } = await createTestPage();
    hold(RIGHT_TRIGGER);
    await frames(300);
    hold(RIGHT_TRIGGER, STOP);
    await frames(300);
    expect(device.store.getState().snapshot.latch).toMatchObject({ reason: 'pressed' });
    expect(ofKind('stop').length).toBeGreaterThan(0);
    expect(isDriving()).toBe(false);
    device.resume();
    expect(await movesIn(500)).toBe(0);
    expect(isDriving()).toBe(false);
  });

  test('on the pad works while driving is off, once a press', async () => {
    const { hold, frames, device } = await createTestPage({ drives: false });
    hold(STOP);
    await frames(1000);
    expect(device.store.getState().snapshot.latch).not.toBeNull();
    // Held on, it stops nobody again who has resumed.
    device.resume();
    await frames(1000);
    expect(device.store.getState().snapshot.latch).toBeNull();
  });

  test('from anywhere else switches off, and stopped it cannot be switched on', async () => {
    const { device, frames, pad, isDriving } = await createTestPage();
    device.halt();
    await frames(50);
    expect(isDriving()).toBe(false);
    pad.drive(step);
    expect(isDriving()).toBe(false);
  });
});

describe('driving by keys', () => {
  test('a held key turns its servo; any key-up ends all of them', async () => {
    const { pad, frames, target, movesIn } = await createTestPage();
    expect(pad.keyDown('KeyQ', false)).toBe(true);
    await frames(400);
    expect(target()).toBeGreaterThan(1600);
    pad.keyUp();
    expect(await movesIn(400)).toBe(0);
    expect(pad.keyDown('KeyQ', true)).toBe(true);
    expect(await movesIn(400)).toBe(0);
  });

  test('leaving the window lets go of the keys, and coming back does not press them', async () => {
    const { pad, frames, movesIn } = await createTestPage();
    pad.keyDown('KeyQ', false);
    await frames(200);
    pad.leave();
    expect(await movesIn(400)).toBe(0);
    pad.comeBack();
    expect(await movesIn(400)).toBe(0);
  });

  test('keys that are not bound, that everybody needs, or while it is off, are for others', async () => {
    const { pad } = await createTestPage();
    expect(pad.keyDown('KeyM', false)).toBe(false);
    expect(pad.keyDown('Escape', false)).toBe(false);
    pad.drive(null);
    expect(pad.keyDown('KeyQ', false)).toBe(false);
  });
});

describe('listening for an input', () => {
  test('tells the one that is moved and obeys none meanwhile', async () => {
    const { pad, hold, frames, movesIn, device } = await createTestPage();
    const heard: Input[] = [];
    pad.listen((input) => heard.push(input));
    await frames(50);
    expect(heard).toEqual([]);
    hold(STOP);
    await frames(20);
    expect(heard).toEqual([{ kind: 'button', index: STOP }]);
    expect(await movesIn(200)).toBe(0);
    expect(device.store.getState().snapshot.latch).toBeNull();
    pad.listen((input) => heard.push(input));
    expect(pad.keyDown('KeyM', false)).toBe(true);
    pad.keyUp();
    expect(heard[1]).toEqual({ kind: 'key', code: 'KeyM' });
  });

  test('given up, the next press is obeyed as ever', async () => {
    const { pad, hold, frames, device } = await createTestPage();
    const giveUp = pad.listen(() => expect.unreachable());
    giveUp();
    hold(STOP);
    await frames(50);
    expect(device.store.getState().snapshot.latch).not.toBeNull();
  });
});
