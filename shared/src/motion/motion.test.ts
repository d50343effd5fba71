import { forgotten, UNKNOWN_MOTION, type KnownBoard, type Motion } from './model.ts';
import { describe, expect, test } from 'vitest';
import type { Command, Frame } from '../codec/commands.ts';
import { family, type FamilyId } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import { haltPlan } from './haltPlan.ts';
import { advance, afterCommand, leewayAt, passMs, positionAt, targetOf } from './motion.ts';
import { afterEnd, afterReport } from './reports.ts';

type Groups = Readonly<Record<number, readonly Frame[]>>;

function frame(
  durationMs: number,
  ...targets: readonly (readonly [servo: number, position: number])[]
): Frame {
  return { durationMs, targets: targets.map(([servo, position]) => ({ servo, position })) };
}

function move(...of: Parameters<typeof frame>): Command {
  return { kind: 'move', ...frame(...of) };
}

function run(slot: number, times = 1): Command {
  return { kind: 'run', slot, times };
}

const STOP: Command = { kind: 'stop' };
const END: Report = { kind: 'runFinished', slot: null };

/** A board whose servos 1 and 2 rest at 1000 at time 0, and what comes to it. */
function robot(id: FamilyId, groups: Groups = {}) {
  const board: KnownBoard = { family: family(id), playedFrames: (slot) => groups[slot] ?? null };
  let motion: Motion = UNKNOWN_MOTION;
  const self = {
    send(atMs: number, command: Command) {
      motion = afterCommand(motion, command, atMs, board);
      return self;
    },
    hear(atMs: number, report: Report) {
      motion =
        report.kind === 'runFinished'
          ? afterEnd(motion, report.slot, atMs, board)
          : afterReport(motion, report, atMs, board);
      return self;
    },
    forget(atMs: number) {
      motion = forgotten(motion, atMs);
      return self;
    },
    at: (nowMs: number, servo = 1) => positionAt(advance(motion, nowMs, board), servo, nowMs),
    when: (nowMs: number) => advance(motion, nowMs, board),
    leeway: (nowMs: number) => leewayAt(advance(motion, nowMs, board), 1, nowMs, board.family),
    plan: (nowMs: number) => haltPlan(motion, nowMs, board),
    passMs: (frames: readonly Frame[]) => passMs(frames, board),
  };
  return self.send(-1_000, move(20, [1, 1_000], [2, 1_000]));
}

describe('a servo without a command', () => {
  test('has no position and no target', () => {
    expect(positionAt(UNKNOWN_MOTION, 1, 0)).toBeNull();
    expect(targetOf(UNKNOWN_MOTION, 1)).toBeNull();
  });

  test('stays unknown through its first move and is known from its end on', () => {
    const doc = robot('doc').send(0, move(1_500, [3, 2_000]));
    expect([doc.at(1_499, 3), doc.at(1_500, 3)]).toEqual([null, 2_000]);
  });
});

describe('a move', () => {
  test('is linear in time', () => {
    const doc = robot('doc').send(0, move(1_000, [1, 2_000]));
    expect([doc.at(250), doc.at(2_000)]).toEqual([1_250, 2_000]);
  });

  test('takes whole ticks, at least 20 ms (S27, L5)', () => {
    expect(
      robot('doc')
        .send(0, move(50, [1, 2_000]))
        .at(40),
    ).toBe(2_000);
    expect(
      robot('doc')
        .send(0, move(0, [1, 2_000]))
        .at(10),
    ).toBe(1_500);
    expect(
      robot('learm-esp32')
        .send(0, move(39, [2, 2_000]))
        .at(30, 2),
    ).toBe(2_000);
  });

  test('of one servo re-times every other where the board has one time for all (S26)', () => {
    const both = (id: FamilyId) =>
      robot(id)
        .send(0, move(5_000, [1, 2_000]))
        .send(2_500, move(50, [2, 1_500]));
    expect(both('doc').at(2_540)).toBe(2_000);
    expect(both('lsc-6').at(2_540)).toBe(1_508);
  });

  test('leaves a way of one tick open, and nothing once it has ended', () => {
    const learm = robot('learm-esp32').send(0, move(1_000, [1, 2_000]));
    expect([learm.leeway(500), learm.leeway(1_000)]).toEqual([10, 0]);
    expect(learm.send(500, move(10_000, [1, 2_000])).leeway(600)).toBeGreaterThan(10);
  });
});

describe('a group on deadlines', () => {
  const groups = {
    1: [frame(100, [1, 2_000]), frame(100, [1, 1_000])],
    2: [frame(100, [1, 500])],
    100: [frame(200, [1, 1_200])],
    101: [frame(100, [1, 1_700])],
  };
  /** Says nothing before it runs a group. */
  const old = () => robot('openarm-old', groups);

  test('is followed frame by frame (S42)', () => {
    const running = old().send(0, run(1, 2));
    expect([50, 100, 150, 200, 250, 400, 900].map((nowMs) => running.at(nowMs))).toEqual([
      1_500, 2_000, 1_500, 1_000, 1_500, 1_000, 1_000,
    ]);
  });

  test('begins when the board has said so (S18, X1)', () => {
    expect(robot('openarm-new', groups).send(0, run(1)).at(4)).toBe(1_000);
    expect(robot('openarm-new', groups).send(0, run(1)).at(54.2)).toBe(1_500);
    expect(robot('lsc-6', groups).send(0, run(1)).at(57.3)).toBe(1_500);
  });

  test('ends after its frame in progress when stopped (S50)', () => {
    expect(old().send(0, run(1, 0)).send(50, STOP).at(5_000)).toBe(2_000);
  });

  test('changes its repeats when it is run again, without a restart (S45)', () => {
    const again = old().send(0, run(1, 0)).send(150, run(1, 1));
    expect([again.at(200), again.at(250)]).toEqual([1_000, 1_000]);
  });

  test('is cut short by a request for another one (S46)', () => {
    expect(old().send(0, run(1, 0)).send(50, run(2)).at(150)).toBe(1_000 + 1_000 / 2 + 500);
  });

  test('makes way for group 0 (S47)', () => {
    const both = robot('openarm-old', { ...groups, 0: [frame(1_000, [1, 500])] });
    expect(both.send(0, run(1, 0)).send(100, run(0)).at(1_100)).toBe(500);
  });

  test('100 is followed by 101, where the board does so (S49)', () => {
    expect(robot('openarm-new', groups).send(0, run(100)).at(400)).toBe(1_700);
    expect(old().send(0, run(100)).at(400)).toBe(1_200);
  });

  test('101 is not ended by the word for the end of 100', () => {
    const heard = robot('openarm-new', groups).send(0, run(100)).hear(215, END);
    expect(heard.when(215).run).not.toBeNull();
    expect(heard.hear(290, END).when(290).run).toBeNull();
  });

  test('makes every servo unknown when its frames are not ours, whatever is sent meanwhile', () => {
    const unknown = old()
      .send(0, run(9))
      .send(500, move(20, [1, 1_500]));
    expect([unknown.at(600), unknown.at(60_000)]).toEqual([null, null]);
    expect(
      unknown
        .send(70_000, STOP)
        .send(70_100, move(20, [1, 1_500]))
        .at(70_120),
    ).toBe(1_500);
  });

  test('of no time at all is played an unknown number of times', () => {
    const timeless = robot('openarm-old', { 3: [frame(0, [1, 2_000]), frame(0, [1, 1_000])] });
    expect(timeless.send(0, run(3, 0)).at(100)).toBeNull();
  });

  test('started by another client makes all unknown until its end', () => {
    const started = robot('lsc-6', groups).hear(0, { kind: 'runStarted', slot: 1, times: 1 });
    expect(started.at(10)).toBeNull();
    expect(
      started
        .hear(300, END)
        .send(400, move(100, [1, 900]))
        .at(500),
    ).toBe(900);
  });

  test('of ours is not disturbed by the board saying so', () => {
    const own = robot('lsc-6', groups).send(0, run(1)).hear(30, { kind: 'runStarted', slot: 1, times: 1 });
    expect(own.at(57.3)).toBe(1_500);
  });

  test('goes on when the end of the one before it is reported late, and not which it was', () => {
    const two = { 3: [frame(40, [1, 2_000])], 4: [frame(400, [1, 1_000])] };
    const next = robot('doc', two).send(0, run(3)).send(60, run(4)).hear(64, END);
    expect(next.when(100).run).not.toBeNull();
    expect(next.hear(200, END).when(200).run).toBeNull();
    const later = robot('doc', two).send(0, run(3)).hear(50, END).send(60, run(4));
    expect(later.hear(200, END).when(200).run).toBeNull();
  });

  test('goes on when the end of another one is reported late', () => {
    const next = robot('lsc-6', groups).send(0, run(1));
    const late = next.hear(5, { kind: 'runFinished', slot: 8 });
    expect(late.at(57.3)).toBe(1_500);
    expect(next.hear(60, { kind: 'runFinished', slot: 1 }).when(60).run).toBeNull();
  });
});

describe("LeArm's groups", () => {
  const groups = {
    1: [frame(100, [1, 1_400], [6, 2_000]), frame(200, [1, 1_000])],
    2: [frame(100, [1, 700])],
  };
  const learm = () => robot('learm-esp32', groups).send(-500, move(20, [1, 1_000], [6, 1_000]));

  test('are known in the first frame, then where they end, and nowhere between (L7)', () => {
    const running = learm().send(0, run(1));
    expect([50, 100, 101, 400].map((nowMs) => running.at(nowMs))).toEqual([1_200, null, null, null]);
    expect([running.at(1_000), running.at(1_000, 6)]).toEqual([1_000, 2_000]);
  });

  test('halt but for the base (L9)', () => {
    const stopped = learm().send(0, run(1)).send(50, STOP);
    expect([stopped.at(500), stopped.at(500, 6)]).toEqual([1_200, 2_000]);
    expect(stopped.leeway(500)).toBeGreaterThan(0);
  });

  test('die of any other command (L8), and the next one leaves its first frame out (L11)', () => {
    const killed = learm().send(0, run(1)).send(50, { kind: 'readBattery' });
    expect(killed.at(5_000)).toBe(1_400);
    expect(killed.send(6_000, run(1)).at(6_100)).toBe(1_200);
  });

  test('may have died or not where a command came about their end', () => {
    const perhaps = learm().send(0, run(2)).send(120, { kind: 'readBattery' });
    expect(perhaps.at(200)).toBe(700);
    expect(perhaps.send(6_000, run(1)).at(6_050)).toBeNull();
  });

  test('take longer than their frames', () => {
    expect(learm().passMs(groups[1])).toBeGreaterThanOrEqual(100 + 200 + 2 * 110);
    expect(robot('doc').passMs(groups[1])).toBe(300);
  });
});

describe('a board busy with its flash', () => {
  const download: Command = {
    ...{ kind: 'download', slot: 3, frameCount: 2, frameIndex: 0 },
    frame: frame(100, [1, 2_000]),
  };
  const busy = () =>
    robot('doc')
      .send(0, move(1_000, [1, 2_000]))
      .send(100, download);

  test('freezes what is on its way and lets it jump (S29): unknown until it has arrived', () => {
    expect([busy().at(200), busy().at(200, 2), busy().at(3_000)]).toEqual([null, 1_000, 2_000]);
  });

  test('may drop what comes meanwhile', () => {
    const moved = busy().send(200, move(20, [2, 1_500]));
    expect(moved.at(5_000, 2)).toBeNull();
    expect(
      busy()
        .send(200, move(20, [2, 1_000]))
        .at(300, 2),
    ).toBe(1_000);
  });

  test('hears again when it has answered', () => {
    const heard = busy()
      .hear(300, { kind: 'frameStored' })
      .send(310, move(20, [2, 1_500]));
    expect(heard.at(330, 2)).toBe(1_500);
  });

  test('takes up first what waited meanwhile, and may drop what comes right behind its answer (S9)', () => {
    const waited = () =>
      busy()
        .send(200, move(20, [2, 1_000]))
        .hear(300, { kind: 'frameStored' });
    const behind = (atMs: number) => waited().send(atMs, move(20, [2, 1_500]));
    expect([behind(300).at(5_000, 2), behind(301).at(5_000, 2)]).toEqual([null, null]);
    expect(behind(310).at(5_000, 2)).toBe(1_500);
  });

  test('goes on with a group that is played to an unknown point', () => {
    const running = robot('doc', { 1: [frame(100, [1, 2_000])] })
      .send(0, run(1, 0))
      .send(50, download);
    expect(running.at(200)).toBeNull();
  });
});

test('released servos are unknown, the others are not (X7)', () => {
  const xarm = robot('xarm').send(0, { kind: 'release', servos: [1] });
  expect([xarm.at(0), xarm.at(0, 2)]).toEqual([null, 1_000]);
});

describe('what a board says of its servos', () => {
  const says = (position: number): Report => ({ kind: 'positions', positions: [{ servo: 7, position }] });

  test('makes one that was not moved known, as a place and not as a wish', () => {
    const xarm = robot('bus-ctrl').hear(500, says(300));
    expect([xarm.at(600, 7), targetOf(xarm.when(600), 7)]).toEqual([300, null]);
    xarm.send(1_000, move(1_000, [7, 700]));
    expect([xarm.at(1_500, 7), xarm.at(2_000, 7)]).toEqual([500, 700]);
  });

  test('a hold leaves that one alone: it may have no torque', () => {
    expect(
      robot('bus-ctrl')
        .hear(500, says(300))
        .plan(600)
        .hold?.targets.map(({ servo }) => servo),
    ).toEqual([1, 2]);
  });

  test('does not last for one that was let go: a hand may turn it', () => {
    const xarm = robot('bus-ctrl')
      .send(0, { kind: 'release', servos: [7] })
      .hear(500, says(300));
    expect(xarm.at(600, 7)).toBeNull();
    xarm.send(700, { kind: 'readPositions', servos: [7] }).send(800, move(100, [7, 500]));
    expect(xarm.hear(900, says(300)).at(900, 7)).toBeNull();
    expect(xarm.forget(1_000).hear(60_000, says(300)).at(60_000, 7)).toBeNull();
  });

  test('says nothing while something may move it', () => {
    const running = robot('bus-ctrl').send(0, run(9)).hear(500, says(300));
    expect(running.at(600, 7)).toBeNull();
    running.send(1_000, STOP).hear(2_000, says(300));
    expect(running.at(2_100, 7)).toBeNull();
    expect(running.hear(40_000, says(310)).at(40_000, 7)).toBe(310);
  });

  test('is no longer so behind a run, and forgotten with everything else', () => {
    const xarm = robot('bus-ctrl', { 5: [frame(100, [1, 500])] });
    expect(xarm.hear(500, says(300)).send(600, run(5)).at(5_000, 7)).toBeNull();
    expect(robot('bus-ctrl').hear(500, says(300)).forget(600).at(700, 7)).toBeNull();
  });

  test('is where one that was moved stands, too; a hold goes on with what it was asked for', () => {
    const gripping = robot('bus-ctrl').hear(500, {
      kind: 'positions',
      positions: [{ servo: 1, position: 3 }],
    });
    expect(gripping.at(600)).toBe(3);
    expect(gripping.plan(600).hold?.targets[0]).toEqual({ servo: 1, position: 1_000 });
    expect(gripping.send(1_000, move(1_000, [1, 503])).at(1_500)).toBe(253);
  });

  test('changes nothing of one that is under way', () => {
    const moving = robot('bus-ctrl').send(100, move(1_000, [1, 500]));
    expect(moving.hear(600, { kind: 'positions', positions: [{ servo: 1, position: 3 }] }).at(600)).toBe(750);
  });
});

test('nothing is known of a robot that was out of sight', () => {
  expect(robot('doc').forget(0).at(0)).toBeNull();
});
