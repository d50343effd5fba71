// How long a whole action group takes to the board, over what nothing can go below: the wire, the flash chip and the
// acknowledgements. The limit is computed here from documented figures, not asked of the simulator.

import type { Frame } from '#shared/codec/commands.ts';
import { encodeCommand, encodeReport } from '#shared/codec/encode.ts';
import { family as familyOf } from '#shared/codec/families.ts';
import { wireMs } from '#shared/codec/packet.ts';
import { createRig } from '#shared/robot/rig.ts';
import type { Figure } from './figure.ts';

/** A short arm group and the longest dance of the known collections (boards.md chapter 9). */
const GROUPS = [
  { frameCount: 21, servoCount: 6 },
  { frameCount: 237, servoCount: 16 },
] as const;
type Group = (typeof GROUPS)[number];

/** The chip's data sheet, typical (boards.md section 3.3, flash times). */
const SECTOR_ERASE_MS = 45;
const PAGE_PROGRAM_MS = 0.8;
/** Before its first frame a group's four sectors are erased, after its last the count table's one (S33, S34). */
const SECTORS_OF_A_GROUP = 4;
const SECTORS_OF_THE_COUNTS = 1;

const GIVE_UP_MS = 600_000;
const slot = 5;
const family = familyOf('doc');

export async function measureDownload(): Promise<Figure[]> {
  const figures: Figure[] = [];
  for (const group of GROUPS) {
    const value = await downloadMs(group);
    const against = { what: 'computed limit', value: physicalLimitMs(group) };
    const key = `download.${group.frameCount}x${group.servoCount}`;
    const note = `${group.frameCount} frames of ${group.servoCount} servos: wire, erase, program, answers`;
    figures.push({ key: `${key}.timeMs`, value, unit: 'ms', against, note });
    figures.push(overLimit(key, value / against.value, 'time over limit; one run in virtual time is exact'));
  }
  const ratios = figures.filter(({ unit }) => unit === '').map(({ value }) => value);
  return [...figures, overLimit('download', Math.max(...ratios), 'the larger of the two')];
}

function overLimit(key: string, value: number, note: string): Figure {
  return { key: `${key}.overLimit`, value, unit: '', note };
}

/** In virtual time, from the call to the moment the session says that all is stored. */
async function downloadMs(group: Group): Promise<number> {
  const { clock, session, channel } = await createRig({ servoCount: group.servoCount });
  const startMs = clock.now();
  let storedMs = NaN;
  void session.download([{ slot, frames: framesOf(group) }]).then(() => (storedMs = clock.now()));
  while (Number.isNaN(storedMs) && clock.now() - startMs < GIVE_UP_MS) await clock.advance(100);
  if (channel.board.frameCount(slot) !== group.frameCount) throw new Error('the group was not stored');
  return storedMs - startMs;
}

function physicalLimitMs(group: Group): number {
  const ackBytes = encodeReport({ kind: 'frameStored' }).length;
  const frames = framesOf(group);
  const wire = frames.reduce((sum, frame, frameIndex) => {
    const command = { kind: 'download', slot, frameCount: frames.length, frameIndex, frame } as const;
    return sum + wireMs(encodeCommand(command, family).length + ackBytes);
  }, 0);
  const pages = frames.length + SECTORS_OF_THE_COUNTS;
  return wire + (SECTORS_OF_A_GROUP + SECTORS_OF_THE_COUNTS) * SECTOR_ERASE_MS + pages * PAGE_PROGRAM_MS;
}

function framesOf({ frameCount, servoCount }: Group): readonly Frame[] {
  return Array.from({ length: frameCount }, (_, frameIndex) => ({
    durationMs: 300,
    targets: Array.from({ length: servoCount }, (_, index) => ({
      servo: index + 1,
      position: 1_000 + ((frameIndex * 7 + index) % 1_000),
    })),
  }));
}
