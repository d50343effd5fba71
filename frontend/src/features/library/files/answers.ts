// The answers about a group in a file (the unit of its positions, and whether to convert them to the board's), and the group that is
// imported with them. Pure.

import { type Reading, type Unit, inUnit, meaningIn, onlyFittingUnit } from '#shared/files/reading.ts';
import { convertGroup } from '#shared/group/frameEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';

export interface Answer {
  /** null until it is answered. */
  readonly unit: Unit | null;
  readonly converts: boolean;
}

/** The unit in the file, or the only one that its numbers allow. */
export function firstAnswers(reading: Reading): readonly Answer[] {
  if (!('groups' in reading)) return [];
  return reading.groups.map((group) => ({
    unit: reading.isUnitMissing ? onlyFittingUnit(group) : group.unit,
    converts: false,
  }));
}

/** null if the board has this unit already, or if a position is outside the range of the unit. */
export function convertedOf(found: ActionGroup, { unit }: Answer, boardUnit: Unit): ActionGroup | null {
  const said = inUnit(found, unit ?? found.unit);
  const isSound = said.unit !== boardUnit && meaningIn(said.unit, said).outside === 0;
  return isSound ? convertGroup(said, boardUnit) : null;
}

export function takenAs(found: ActionGroup, answer: Answer, boardUnit: Unit): ActionGroup {
  const converted = answer.converts ? convertedOf(found, answer, boardUnit) : null;
  return converted ?? inUnit(found, answer.unit ?? found.unit);
}

export interface AnsweredFile {
  readonly id: number;
  readonly reading: Reading;
  readonly answers: readonly Answer[];
}

export interface ReadyGroup {
  /** The id of the file. */
  readonly file: number;
  readonly group: ActionGroup;
}

/** Numbers of files with groups, and of files that could not be read. */
export interface FileCounts {
  readonly opened: number;
  readonly refused: number;
}

export function countsOf(files: readonly Pick<AnsweredFile, 'reading'>[]): FileCounts {
  const opened = files.filter(({ reading }) => 'groups' in reading).length;
  return { opened, refused: files.length - opened };
}

/** The groups of files without an open question. */
export function readyGroups(files: readonly AnsweredFile[], boardUnit: Unit): readonly ReadyGroup[] {
  return files.flatMap(({ id, reading, answers }) => {
    if (!('groups' in reading)) return [];
    if (answers.some(({ unit }) => unit === null)) return [];
    return reading.groups.flatMap((found, index) => {
      const answer = answers[index];
      return answer === undefined ? [] : [{ file: id, group: takenAs(found, answer, boardUnit) }];
    });
  });
}
