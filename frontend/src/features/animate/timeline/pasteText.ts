// Why frames or keys were not pasted, in a sentence.

import type { PasteProblem } from '#shared/group/clip.ts';
import { words } from '../../../i18n/whole.ts';

export function notPasted(problem: PasteProblem, nameOf: (servo: number) => string): string {
  return words.timeline.notPasted({ problem: problemText(problem, nameOf) });
}

function problemText(problem: PasteProblem, nameOf: (servo: number) => string): string {
  const { pasteProblems } = words.timeline;
  switch (problem.kind) {
    case 'unit':
      return pasteProblems.unit({ clip: words.units[problem.clip], group: words.units[problem.group] });
    case 'tooManyFrames':
      return pasteProblems.tooManyFrames(problem);
    case 'position':
      return pasteProblems.position({ ...problem, name: nameOf(problem.servo) });
  }
}
