// What keeps a group from the board, in words: its servos by the names they have on the robot it was judged for.

import type { CompileProblem } from '#shared/actions/group/compileReport.ts';
import { words } from '../../words/words.ts';
import { namesIn } from '../servoName.ts';
import type { Source } from './workedOut.ts';

export function problemText(problem: CompileProblem, { group, robot }: Source): string {
  return words.compile.problem(problem, group, namesIn(robot));
}
