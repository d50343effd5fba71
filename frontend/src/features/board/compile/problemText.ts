// What keeps a group from the board, in words: its servos by the names they have on the robot it was judged for. Apart from compiled.ts,
// which is in the first load.

import type { CompileProblem } from '#shared/group/compileReport.ts';
import { words } from '../../../i18n/whole.ts';
import { namesIn } from '../../../i18n/sentences.ts';
import type { Source } from './compileSource.ts';

export function problemText(problem: CompileProblem, { group, robot }: Source): string {
  const reasons = words.compile.reasons;
  const nameOf = namesIn(robot);
  const frameNumber = (id: number): number => group.frames.findIndex((frame) => frame.id === id) + 1;
  switch (problem.kind) {
    case 'unit':
      return reasons.unit({ group: words.units[problem.group], board: words.units[problem.board] });
    case 'servo':
      return reasons.servo({ ...problem, name: nameOf(problem.servo) });
    case 'position':
      return reasons.position({
        ...problem,
        name: nameOf(problem.servo),
        frame: frameNumber(problem.frameId),
      });
    case 'tooManyServos':
      return reasons.tooManyServos({ ...problem, frame: problem.frame + 1 });
    case 'tooManyFrames':
      return reasons.tooManyFrames(problem);
    case 'tooShort':
      return reasons.tooShort({
        ...problem,
        name: nameOf(problem.servo),
        frame: frameNumber(problem.frameId),
      });
    case 'tooFast':
      return reasons.tooFast({ ...problem, name: nameOf(problem.servo) });
    case 'deviation': {
      const { atMs, units, limit, servo } = problem;
      const positionText = words.position[group.unit];
      return reasons.deviation({
        ...{ name: nameOf(servo), atMs, error: positionText({ position: Math.round(units) }) },
        allowed: positionText({ position: limit }),
      });
    }
  }
}
