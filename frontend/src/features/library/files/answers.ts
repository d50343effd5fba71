// What a person says of a group that stands in a file: the unit of its positions, and whether they become those of the board; and the group
// as it is taken over then. Pure.

import { type Reading, type Unit, inUnit, meaningIn, onlyFittingUnit } from '#shared/files/reading.ts';
import { convertGroup } from '#shared/group/frameEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';

export interface Answer {
  /** null: nobody has said yet. */
  readonly unit: Unit | null;
  readonly converts: boolean;
}

/** Before a person says anything: what the file says, or its numbers leave as the only choice. */
export function firstAnswers(reading: Reading): readonly Answer[] {
  if (!('groups' in reading)) return [];
  return reading.groups.map((group) => ({
    unit: reading.asksUnit ? onlyFittingUnit(group) : group.unit,
    converts: false,
  }));
}

/** null where the board counts so already, or a position of it is none of its own unit. */
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
  /** The id of its file. */
  readonly file: number;
  readonly group: ActionGroup;
}

/** Files with groups, and those that could not be opened. */
export interface FileCounts {
  readonly opened: number;
  readonly refused: number;
}

export function countsOf(files: readonly Pick<AnsweredFile, 'reading'>[]): FileCounts {
  const opened = files.filter(({ reading }) => 'groups' in reading).length;
  return { opened, refused: files.length - opened };
}

/** The groups of the files that nothing more has to be asked about. */
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
