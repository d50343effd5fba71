// A group as a file of any format, with what that format cannot hold. Databases are made by what is handed in.

import type { Family } from '../codec/families.ts';
import type { ActionGroup } from '../group/group.ts';
import { groupToFile } from '../group/groupText.ts';
import type { Robot } from '../profile/robot.ts';
import { arduinoOf } from './arduino.ts';
import { writeCsv } from './csv.ts';
import { fileNameOf } from './fileName.ts';
import { filled } from './filled.ts';
import { OTHER_UNIT, type Misfit } from './fit.ts';
import { programOf, type Program } from './program.ts';
import { pythonOf } from './python.ts';
import { ROB_SERVOS, writeRob } from './rob.ts';
import { sheetOf, type Sheet } from './sheet.ts';
import { writeXml } from './xml.ts';

export const SAVE_FORMATS = ['json', 'xml', 'd6a', 'rob', 'csv', 'python', 'arduino'] as const;
export type SaveFormat = (typeof SAVE_FORMATS)[number];

export const EXTENSIONS: Readonly<Record<SaveFormat, string>> = {
  ...{ json: '.json', xml: '.xml', d6a: '.d6a', rob: '.rob', csv: '.csv' },
  ...{ python: '.py', arduino: '.ino' },
};

export interface SavedFile {
  readonly name: string;
  readonly content: string | Uint8Array<ArrayBuffer>;
}

export interface Board {
  readonly family: Family;
  readonly robot: Robot;
}

export type MakeDatabase = (sheet: Sheet) => Promise<Uint8Array<ArrayBuffer>>;

/** Misfits only where nothing was written: a program must not send what cannot be, a .rob file has 40 servos of a bus, in steps. */
export async function writeGroupFile(
  format: SaveFormat,
  group: ActionGroup,
  { family, robot }: Board,
  makeDatabase: MakeDatabase,
): Promise<SavedFile | { readonly misfits: readonly Misfit[] }> {
  const whole: ActionGroup = { ...group, frames: filledFrames(group) };
  const program = (write: (program: Program) => string) => {
    const made = programOf(group, family, robot);
    return 'misfits' in made ? made : write(made.program);
  };
  const written = await {
    json: () => groupToFile(group),
    xml: () => writeXml(whole),
    d6a: () => makeDatabase(sheetOf(whole)),
    rob: () => robOf(whole),
    csv: () => writeCsv(whole),
    python: () => program(pythonOf),
    arduino: () => program(arduinoOf),
  }[format]();
  if (typeof written === 'object' && 'misfits' in written) return written;
  return { name: fileNameOf(group, EXTENSIONS[format]), content: written };
}

function filledFrames(group: ActionGroup): ActionGroup['frames'] {
  const { frames } = filled(group);
  return group.frames.map((frame, index) => ({ ...frame, ...frames[index] }));
}

function robOf(group: ActionGroup): Uint8Array<ArrayBuffer> | { readonly misfits: readonly Misfit[] } {
  if (group.unit !== 'steps') return { misfits: [OTHER_UNIT] };
  const strangers = group.frames.flatMap(({ targets }, index) =>
    targets
      .filter(({ servo }) => servo < 1 || servo > ROB_SERVOS)
      .map(({ servo }) => ({ servo, frame: index + 1 })),
  );
  const [first] = strangers;
  if (first === undefined) return writeRob(group);
  const frames = strangers.filter(({ servo }) => servo === first.servo).map(({ frame }) => frame);
  const values = { min: first.servo, max: first.servo };
  const allowed = { min: 1, max: ROB_SERVOS };
  return { misfits: [{ code: 'servo', servo: first.servo, frames, values, allowed }] };
}
