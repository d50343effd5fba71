// Files of action groups for tests and measurements: the made-up ones of shared/protocol/vectors/files with what they mean, and as
// many in every format as are wanted, as large as real ones are (boards.md section 9).

import meanings from '../../protocol/vectors/files/meanings.json' with { type: 'json' };
import type { Reading } from '../files/reading.ts';
import { FAMILIES, type Family } from '../codec/families.ts';
import { emptyGroup, type ActionGroup } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { writeGroupFile, type MakeDatabase, type SavedFile } from '../files/writeGroupFile.ts';

// The made-up files of shared/protocol/vectors/files with what they mean, for tests.

export const MEANINGS = meanings;

/** As the twin of a fixture says it. */
export function meaningOf(reading: Reading) {
  if ('problem' in reading) return reading;
  const { groups, asksUnit, remarks } = reading;
  return groups.map(({ name, slot, unit, frames }) => ({
    ...{ name, slot, unit, asksUnit, remarks: remarks.map(({ code }) => code) },
    frames: frames.map(({ durationMs, targets }) => ({ durationMs, targets })),
  }));
}

// Files of action groups in every format that can be opened, as large as real ones are (boards.md section 9), for
// tests and measurements.

const SERVOS = 16;
/** From the median of a real collection to its largest. */
const FRAME_COUNTS = [6, 12, 56, 120, 237];
const FORMATS = ['xml', 'd6a', 'csv', 'rob', 'json'] as const;

export async function mixedFiles(count: number, makeDatabase: MakeDatabase): Promise<readonly SavedFile[]> {
  const files: SavedFile[] = [];
  for (let index = 0; index < count; index += 1) {
    const format = FORMATS[index % FORMATS.length] ?? 'xml';
    const boardId = format === 'rob' ? 'xarm' : 'doc';
    const board = FAMILIES[boardId];
    const frames = FRAME_COUNTS[Math.floor(index / FORMATS.length) % FRAME_COUNTS.length] ?? 0;
    const group = groupOf(`mixed ${index + 1}`, frames, board);
    const names = { robot: 'Plain', role: (role: string) => role, limb: (limb: string) => limb };
    const robot = readyRobot('plain16', boardId, names);
    const made = await writeGroupFile(format, group, { family: board, robot }, makeDatabase);
    if ('content' in made) files.push(made);
  }
  return files;
}

/** Pulse widths below 1000 µs too, so that no file without a unit leaves a choice. */
function groupOf(name: string, frames: number, { unit, position: { min, max } }: Family): ActionGroup {
  const middle = (min + max) / 2;
  return Array.from({ length: frames }).reduce<ActionGroup>(
    (group, _, frame) => {
      const targets = Array.from({ length: SERVOS }, (_each, index) => ({
        servo: index + 1,
        position: Math.round(middle + 0.4 * (max - min) * Math.sin(frame * 0.3 + index)),
      }));
      return insertFrame(group, frame, { durationMs: 300, targets });
    },
    emptyGroup(name, unit),
  );
}
