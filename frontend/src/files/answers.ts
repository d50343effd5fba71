// What a person says of a group that stands in a file: the unit of its positions, and whether they become steps; and the group
// as it is taken over then. Pure.

import type { Reading, Unit } from '#shared/actions/files/reading.ts';
import { inUnit, onlyFittingUnit, toSteps } from '#shared/actions/files/units.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';

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

/** null where a position of it cannot become a step, or where steps are not what the board counts. */
export function convertedOf(found: ActionGroup, { unit }: Answer, boardUnit: Unit): ActionGroup | null {
  return boardUnit === 'steps' ? toSteps(inUnit(found, unit ?? found.unit)) : null;
}

export function takenAs(found: ActionGroup, answer: Answer, boardUnit: Unit): ActionGroup {
  const converted = answer.converts ? convertedOf(found, answer, boardUnit) : null;
  return converted ?? inUnit(found, answer.unit ?? found.unit);
}

export interface AnsweredFile {
  readonly id: number;
  readonly reading: Reading | null;
  readonly answers: readonly Answer[];
}

/** The groups of the files that nothing more has to be asked about. */
export function readyGroups(files: readonly AnsweredFile[], boardUnit: Unit) {
  return files.flatMap(({ id, reading, answers }) => {
    if (reading === null || !('groups' in reading)) return [];
    if (answers.some(({ unit }) => unit === null)) return [];
    return reading.groups.flatMap((found, index) => {
      const answer = answers[index];
      return answer === undefined ? [] : [{ file: id, group: takenAs(found, answer, boardUnit) }];
    });
  });
}
