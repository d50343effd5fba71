// A group as a file of any format, and what that format cannot hold. Databases are made by what is handed in.

import type { Family } from '../codec/families.ts';
import { flattened } from '../group/flattened.ts';
import { type ActionGroup, groupToFile, isStraight } from '../group/group.ts';
import type { Robot } from '../profile/robot.ts';
import { arduinoOf, programOf, type Program, pythonOf } from './program.ts';
import { writeCsv, sheetOf, type Sheet } from './csv.ts';
import { fileNameOf } from './fileName.ts';
import { filled, OTHER_UNIT, type Misfit } from './fit.ts';
import { ROB_SERVOS, writeRob } from './rob.ts';
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
  saved: ActionGroup,
  { family, robot }: Board,
  makeDatabase: MakeDatabase,
): Promise<SavedFile | { readonly misfits: readonly Misfit[] }> {
  // No other format knows blocks.
  const group = flattened(saved);
  const whole: ActionGroup = { ...group, frames: filledFrames(group) };
  const program = (write: (program: Program) => string) => {
    const made = programOf(group, family, robot);
    return 'misfits' in made ? made : write(made.program);
  };
  const written = await {
    json: () => groupToFile(saved),
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
  const unfit = group.frames.flatMap(({ targets }, index) =>
    targets
      .filter(({ servo }) => servo < 1 || servo > ROB_SERVOS)
      .map(({ servo }) => ({ servo, frame: index + 1 })),
  );
  const [first] = unfit;
  if (first === undefined) return writeRob(group);
  const frames = unfit.filter(({ servo }) => servo === first.servo).map(({ frame }) => frame);
  const values = { min: first.servo, max: first.servo };
  const allowed = { min: 1, max: ROB_SERVOS };
  return { misfits: [{ code: 'servo', servo: first.servo, frames, values, allowed }] };
}

// What a format other than ours does not hold of a group, said before saving.

const LOSS_CODES = ['easings', 'marks', 'about', 'times', 'completed', 'lacking'] as const;
type LossCode = (typeof LOSS_CODES)[number];

/** What another format does not keep, or has to be given; with the frames it is about, counted from 1. */
export interface Loss {
  readonly code: LossCode;
  readonly frames: readonly number[];
}

/** Said before saving, so that it is no surprise later. */
export function lossesIn(format: SaveFormat, saved: ActionGroup): readonly Loss[] {
  if (format === 'json') return [];
  const group = flattened(saved);
  const { frames, markers, robot, tags, times, sound } = group;
  const { completed, lacking } = filled(group);
  const isProgram = format === 'python' || format === 'arduino';
  const found: Readonly<Record<LossCode, boolean | readonly number[]>> = {
    easings: isProgram ? [] : frames.flatMap((frame, index) => (isStraight(frame) ? [] : [index + 1])),
    marks:
      sound !== undefined ||
      markers.length > 0 ||
      frames.some(({ note, colour }) => note !== '' || colour !== null),
    about: robot !== '' || tags.length > 0,
    times: times !== 1 && !isProgram,
    completed,
    lacking: isProgram ? [] : lacking,
  };
  return LOSS_CODES.flatMap((code) => {
    const where = found[code];
    if (typeof where === 'boolean') return where ? [{ code, frames: [] }] : [];
    return where.length === 0 ? [] : [{ code, frames: where }];
  });
}
