// Words about files of action groups: opening them, what is wrong with one, saving.

import type { Loss, LossCode } from '#shared/actions/files/losses.ts';
import type { Misfit, MisfitCode } from '#shared/actions/files/fit.ts';
import type { Problem, ProblemCode, Remark, RemarkCode } from '#shared/actions/files/reading.ts';
import type { SaveFormat } from '#shared/actions/files/writeGroupFile.ts';
import { UNIT_RANGE, type Meaning } from '#shared/actions/files/units.ts';
import type { PositionUnit } from '../../numbers.ts';
import { counted, formatList, formatSeconds, formatWhole, unitSymbol } from '../numbers.ts';
import { FLAWS } from '../flaws.ts';

const PROBLEMS: Readonly<Record<ProblemCode, (found: string) => string>> = {
  ...FLAWS,
  empty: () => 'The file is empty.',
  tooLarge: () => 'The file is larger than 8 MB, and no action group is.',
  unreadable: () => 'The browser could not read it. Perhaps it is a folder.',
  unknownFormat: () => 'This is none of the formats that can be opened here.',
  noFrames: () => 'There is no frame in it.',
  tooManyFrames: (found) => `It has ${found} frames; a group has 10000 at most.`,
  cutShort: () => 'The file ends too early; a part of it is missing.',
  badMove: (found) => `“${found}” names no servo and position, as “#1 P1500” does.`,
  badTime: (found) => `“${found}” is no time: whole milliseconds from 0 to 65535.`,
  badServo: (found) => `“${found}” is no servo number: 0 to 255.`,
  badPosition: (found) => `“${found}” is no position: a whole number from 0 to 65535.`,
  unpaired: (found) => `Each frame needs one ID, one Move and one Time; there are ${found}.`,
  notClosed: (found) => `<${found}> has no end.`,
  encrypted: () => 'It is encrypted. The program that wrote it can save it again without.',
  unknownTag: (found) => `Its kind, “${found}”, is unknown.`,
  noColumn: (found) => `The column ${found} is missing.`,
  columnTwice: (found) => `The column ${found} is there twice.`,
  cellCount: (found) => `It has another number of cells than the first line: ${found}.`,
  noTable: (found) => `The database has no table ${found}.`,
  damagedDatabase: (found) => `The database cannot be read: ${found}.`,
};

const REMARKS: Readonly<Record<RemarkCode, (found: string) => string>> = {
  otherEncoding: (found) => `Its text is not UTF-8; it was read as ${found}.`,
  unknownType: (found) => `The kind of servos, “${found}”, is unknown.`,
  columnIgnored: (found) => `The column ${found} is left out.`,
  indexOrder: () => 'The rows stay as they stand, though their numbers say another order.',
  servoTwice: (found) => `Servo ${found} is named twice; the last position counts.`,
  bytesBehind: (found) => `${found} bytes behind the last frame are left out.`,
  nameCut: () => 'The name was cut to 64 characters.',
};

function placed({ place }: Problem | Remark, sentence: string): string {
  if (place === null) return sentence;
  return 'line' in place
    ? `Line ${formatWhole(place.line)}: ${sentence}`
    : `Frame ${formatWhole(place.frame)}: ${sentence}`;
}

const span = ({ min, max }: { readonly min: number; readonly max: number }): string =>
  min === max ? formatWhole(min) : `${formatWhole(min)} to ${formatWhole(max)}`;

const MISFITS: Readonly<Record<MisfitCode, (misfit: Misfit) => string>> = {
  unit: () => 'It is made for boards that count in another unit.',
  frameCount: ({ values, allowed }) =>
    `The board keeps ${formatWhole(allowed.max)} frames; it has ${formatWhole(values.max)}.`,
  slot: ({ values, allowed }) => `The board has the slots ${span(allowed)}, not ${formatWhole(values.max)}.`,
  duration: ({ values, allowed }) => `Times of ${span(values)} ms; the board takes ${span(allowed)} ms.`,
  servoCount: ({ values, allowed }) =>
    `${span(values)} servos at once; the board takes ${formatWhole(allowed.max)}.`,
  servo: ({ servo, allowed }) => `Servo ${formatWhole(servo ?? 0)}; there are servos ${span(allowed)}.`,
  position: ({ servo, values, allowed }) =>
    `Servo ${formatWhole(servo ?? 0)} goes to ${span(values)}; it takes ${span(allowed)}.`,
};

/** So many frames are named; the others are counted. */
const NAMED_FRAMES = 5;

function inFrames(frames: readonly number[]): string {
  const [first] = frames;
  if (first === undefined || first === 0) return '';
  const more = frames.length - NAMED_FRAMES;
  const rest = more > 0 ? ` and ${formatWhole(more)} more` : '';
  const named = more > 0 ? frames.slice(0, NAMED_FRAMES).map(formatWhole).join(', ') : formatList(frames);
  return ` ${frames.length === 1 ? 'Frame' : 'Frames'} ${named}${rest}.`;
}

const LOSSES: Readonly<Record<LossCode, string>> = {
  easings: 'Easings are left out: the ways become straight.',
  marks: 'Notes, colours and markers are left out.',
  about: 'Tags and the robot’s name are left out.',
  times: 'How often it is played is left out.',
  completed: 'Servos that are under way get the position they have there.',
  lacking: 'A servo has no position before it is first named; the vendors’ programs may expect one.',
};

const FORMATS: Readonly<Record<SaveFormat, { readonly name: string; readonly about: string }>> = {
  json: { name: 'Servodeck', about: 'Keeps everything. The one to come back to.' },
  xml: { name: 'XML', about: 'uHand and LeArm programs. uHand opens frames of six servos only.' },
  d6a: { name: '.d6a', about: 'TonyPi, SpiderPi, MasterPi, ArmPi and AiNex.' },
  rob: { name: '.rob', about: 'The Bus Servo Control program, for bus servos 1 to 40.' },
  csv: { name: 'CSV', about: 'Spreadsheets: a row for each frame.' },
  python: { name: 'Python', about: 'A program that plays it over a serial port, with pyserial.' },
  arduino: { name: 'Arduino', about: 'A sketch that plays it while a pin is held.' },
};

const UNITS: Readonly<Record<PositionUnit, string>> = {
  us: 'Pulse widths, for PWM servos',
  steps: 'Steps, for bus servos',
};

export const wholeFileWords = {
  title: 'Files',
  button: (opened: number, refused: number): string =>
    [
      'Files',
      ...(opened === 0 ? [] : [`${formatWhole(opened)} opened`]),
      ...(refused === 0 ? [] : [`${formatWhole(refused)} not opened`]),
    ].join(', '),
  inLibrary: (count: number): string =>
    count === 1
      ? 'One more group is in the library.'
      : `${formatWhole(count)} more groups are in the library.`,
  taken: (name: string, frames: number): string => `${name} is open, ${counted(frames, 'frame')}.`,
  step: (name: string): string => `open ${name}`,
  open: 'Open',
  choose: 'Choose files',
  hint: 'XML, .rob, .d6a, CSV and Servodeck’s own. Or drop them here.',
  list: 'Opened files',
  reading: 'Reading files',
  readSoFar: (done: number, total: number): string =>
    `${formatWhole(done)} of ${counted(total, 'file')} read`,
  unread: (count: number): string => `Cancelled. ${counted(count, 'file')} not read.`,
  taking: 'Adding groups to the library',
  takenSoFar: (done: number, total: number): string =>
    `${formatWhole(done)} of ${counted(total, 'group')} in the library`,
  cancel: 'Cancel',
  refused: (file: string): string => `${file} was not opened.`,
  about: (frames: number, durationMs: number, servos: number): string =>
    `${counted(frames, 'frame')}, ${formatSeconds(durationMs)}, ` + counted(servos, 'servo'),
  slot: (slot: number): string => `for slot ${formatWhole(slot)}`,
  from: (file: string): string => `From ${file}`,
  take: (name: string): string => `Open ${name}`,
  takeVerb: 'Open',
  takeAll: (count: number): string => `Open all ${formatWhole(count)}`,
  takeAllHint: (name: string): string => `${name} is shown then, the others are in the library.`,
  drop: (file: string): string => `Take ${file} off the list`,

  askUnit: 'The file does not say what its positions are:',
  unit: (unit: PositionUnit): string => UNITS[unit],
  meaning: (unit: PositionUnit, { positions, outside }: Meaning): string => {
    const range = `${span(UNIT_RANGE[unit])} ${unitSymbol(unit)}`;
    if (positions === null) return range;
    const fit =
      outside === 0 ? 'all of them fit' : `${formatWhole(outside)} ${outside === 1 ? 'does' : 'do'} not fit`;
    return `${range}. Here ${span(positions)}: ${fit}.`;
  },
  /** The connected one, else the robot's. */
  forBoard: (board: string): string => `Written for ${board}. Without a board, the robot’s own counts.`,
  convert: (to: PositionUnit): string =>
    to === 'steps' ? 'Convert to steps: (µs − 500) ÷ 2, rounded' : 'Convert to µs: steps × 2 + 500',

  problem: (problem: Problem): string => placed(problem, PROBLEMS[problem.code](problem.found)),
  remark: (remark: Remark): string => placed(remark, REMARKS[remark.code](remark.found)),
  moreRemarks: (count: number): string => `And ${formatWhole(count)} more of this kind.`,
  misfits: 'This does not fit the robot at hand. It is opened as it is:',
  misfit: (misfit: Misfit): string => `${MISFITS[misfit.code](misfit)}${inFrames(misfit.frames)}`,

  save: 'Save as',
  nothing: 'There are no frames to save yet.',
  format: (format: SaveFormat): string => FORMATS[format].name,
  formatAbout: (format: SaveFormat): string => FORMATS[format].about,
  loss: ({ code, frames }: Loss): string => `${LOSSES[code]}${inFrames(frames)}`,
  saveVerb: (name: string): string => `Save ${name}`,
  notSaved: 'It was not saved, because this does not fit:',
  saveFailed: 'The file could not be made.',
};
