// Words about files of action groups: opening them, what is wrong with one, saving.

import type { ProblemCode } from '#shared/actions/files/reading.ts';
import { counted, formatWhole } from './numbers.ts';

export const PROBLEMS: Readonly<Record<ProblemCode, (found: string) => string>> = {
  empty: () => 'The file is empty.',
  tooLarge: () => 'The file is larger than 8 MB, and no action group is.',
  unreadable: () => 'The browser could not read it. Perhaps it is a folder.',
  unknownFormat: () => 'This is none of the formats that can be opened here.',
  notOurs: () => 'It is no such file of Servodeck.',
  otherVersion: () => 'Another version of Servodeck has written it.',
  badValue: (found) => `The value of ${found} is none that can be.`,
  sameNumber: (found) =>
    found === ''
      ? 'Two of its parts have the same number.'
      : `${found}: two of its parts have the same number.`,
  sameKey: (found) => `Two buttons have the same key, ${found}.`,
  servoTwice: (found) => `${found}: a servo is there twice.`,
  servoOrder: (found) => `Frame ${found}: its servos are not in ascending order, each once.`,
  poseMissing: () => 'It names a pose that is not in it.',
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

export const fileWords = {
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
};
