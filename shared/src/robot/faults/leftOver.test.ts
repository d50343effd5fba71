// Half a packet that another program left on a serial line: whatever it is, behind the opening no group runs, and every servo stands once
// the frame in progress is over (safety.md section 2). What no byte can prevent is left out here by name.

import { expect, test } from 'vitest';
import type { Command, CommandKind, Frame } from '../../codec/commands.ts';
import { encodeCommand } from '../../codec/encode.ts';
import { FAMILIES, type Family } from '../../codec/families.ts';
import { wireMs } from '../../codec/packet.ts';
import { createSimulatedChannel } from '../../simulator/channel.ts';
import { createFlashChip, createGroupStore, openLayout, type FlashChip } from '../../simulator/groupStore.ts';
import { LEARM_LAYOUT } from '../../simulator/learm/engine.ts';
import type { ProfileName } from '../../simulator/profileNames.ts';
import { named, seeds } from '../../testing/cases.ts';
import { createVirtualClock } from '../../testing/virtualClock.ts';
import { createLocalRobot } from '../localRobot.ts';

const FILE = 'leftOver.test.ts';
const HEADER = 0x55;
const SLOT = 4;
const FRAME_MS = 600;
const LONGEST_MOVE_MS = 30_000;
/** LEN is the third byte: before it a LeArm takes the header of what comes next for a LEN that is more than it has room for (L3). */
const LEN_AT = 2;

interface LeftOver {
  readonly name: string;
  readonly bytes: Uint8Array;
}

function commandsOf(family: Family): readonly Command[] {
  const all = (count: number) =>
    Array.from({ length: count }, (_, index) => ({ servo: index + 1, position: family.centre + 7 * index }));
  const frame: Frame = { durationMs: 1_000, targets: all(family.servosPerFrame) };
  const commands: Readonly<Record<CommandKind, readonly Command[]>> = {
    move: [1, family.servosPerMove].map((count) => ({
      ...{ kind: 'move', durationMs: 1_000, targets: all(count) },
    })),
    run: [{ kind: 'run', slot: SLOT, times: family.runTimes.max }],
    stop: [{ kind: 'stop' }],
    erase: [{ kind: 'erase' }],
    download: [{ kind: 'download', slot: 9, frameCount: 2, frameIndex: 0, frame }],
    readBattery: [{ kind: 'readBattery' }],
    setSpeed: [{ kind: 'setSpeed', slot: null, percent: 50 }],
    release: [{ kind: 'release', servos: [1, 2, 3] }],
    readPositions: [{ kind: 'readPositions', servos: [1, 2, 3] }],
    readVersion: [{ kind: 'readVersion' }],
    readAllPositions: [{ kind: 'readAllPositions' }],
    readOffsets: [{ kind: 'readOffsets' }],
  };
  return family.commands.flatMap((kind) => commands[kind]);
}

/** Every command of such a board cut behind every byte of it, and stray headers. */
function leftOversOf(family: Family): readonly LeftOver[] {
  const isBuffered = family.leftOverBytes < 2 * HEADER;
  const cuts = commandsOf(family).flatMap((command) => {
    const packet = encodeCommand(command, family);
    return Array.from({ length: packet.length }, (_, cut) => ({
      ...{ name: `${command.kind} cut behind ${cut} bytes`, bytes: packet.subarray(0, cut) },
    }));
  });
  if (isBuffered) return cuts.filter(({ bytes }) => bytes.length === 0 || bytes.length > LEN_AT);
  const strays = [1, 2, 3].map((count) => ({
    ...{ name: `${count} stray headers`, bytes: new Uint8Array(count).fill(HEADER) },
  }));
  const jams = [0xfd, 0xfe, 0xff].map((len) => ({
    ...{ name: `LEN ${len}`, bytes: Uint8Array.of(HEADER, HEADER, len, 0x03, 0x0e, 0xf0) },
  }));
  return [...cuts, ...strays, ...jams];
}

/** An endless group of another program's. */
function flashOf(profile: ProfileName, family: Family): FlashChip {
  const chip = createFlashChip();
  const layout = profile.startsWith('learm') ? LEARM_LAYOUT : openLayout(Math.max(8, family.usualServoCount));
  const { min, max } = family.position;
  const pose = (share: number): Frame => ({
    durationMs: FRAME_MS,
    targets: [1, 2].map((servo) => ({ servo, position: min + Math.round((max - min) * share) })),
  });
  createGroupStore(chip, 0, layout).preload(new Map([[SLOT, [pose(0.2), pose(0.4), pose(0.3)]]]));
  return chip;
}

async function opened(profile: ProfileName, family: Family, { bytes }: LeftOver, pauseMs: number) {
  const clock = createVirtualClock();
  const channel = createSimulatedChannel(clock, {
    ...{ profile, flash: flashOf(profile, family), onForMs: 60_000 },
  });
  const { board } = channel;
  const times = family.zeroTimes === 'endless' ? 0 : family.runTimes.max;
  board.receive(encodeCommand({ kind: 'run', slot: SLOT, times }, family));
  await clock.advance(1_000);
  expect(board.runningSlot()).toBe(SLOT);
  board.receive(bytes);
  await clock.advance(wireMs(bytes.length) + pauseMs);

  const robot = createLocalRobot({ channel, clock, family, identifies: true });
  await robot.open();
  await clock.advance(4_000);
  return { clock, robot, board };
}

async function expectRest(profile: ProfileName, family: Family, leftOver: LeftOver, pauseMs: number) {
  const { clock, robot, board } = await opened(profile, family, leftOver, pauseMs);
  expect(robot.state.link.status).toBe('ready');
  expect(board.runningSlot()).toBeNull();
  await clock.advance(LONGEST_MOVE_MS);
  const { pulses, targets } = board.snapshot();
  // A board that gives no pulse before its first target has none to reach.
  expect(pulses.filter((pulse) => pulse !== 0)).toEqual(targets.filter((_, index) => pulses[index] !== 0));
  expect(board.runningSlot()).toBeNull();
  board.powerOff();
}

test.each(Object.values(FAMILIES))(
  '$id: whatever was left on the line, no group runs behind the opening',
  { timeout: 120_000 },
  async (family) => {
    const profile = family.id as ProfileName;
    const leftOvers = leftOversOf(family);
    for (const seed of seeds(leftOvers.length)) {
      const leftOver = leftOvers[seed % leftOvers.length];
      if (leftOver === undefined) continue;
      await named(FILE, seed, leftOver.name, () =>
        expectRest(profile, family, leftOver, (seed * 37) % FRAME_MS),
      );
    }
  },
);
