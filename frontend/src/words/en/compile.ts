// Words about what a group becomes on the board: whether it fits, how far off it is, what keeps it from going there.

import type { CompileProblem } from '#shared/actions/group/compileReport.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import { formatCount, formatMs, formatPosition, formatSeconds, formatWhole, unitSymbol } from './numbers.ts';

type NameOf = (servo: number) => string;

type Said<Problem> = (problem: Problem, group: ActionGroup, nameOf: NameOf) => string;

type ProblemWords = {
  readonly [K in CompileProblem['kind']]: Said<Extract<CompileProblem, { kind: K }>>;
};

const frameNumber = ({ frames }: ActionGroup, id: number): string =>
  formatWhole(frames.findIndex((frame) => frame.id === id) + 1);

const problems: ProblemWords = {
  unit: ({ group, board }) =>
    `The group is in ${unitSymbol(group)}, the board counts in ${unitSymbol(board)}.`,
  servo: ({ servo, min, max }, _group, nameOf) =>
    `${nameOf(servo)}: the board takes servos ${formatWhole(min)} to ${formatWhole(max)}.`,
  position: ({ servo, frameId, position, min, max }, group, nameOf) =>
    `${nameOf(servo)} in frame ${frameNumber(group, frameId)}: ${formatWhole(position)} is out of range; it takes ${formatWhole(min)} to ${formatWhole(max)}.`,
  tooManyServos: ({ frame, count, limit }) =>
    `Frame ${formatWhole(frame + 1)} on the board would move ${formatCount(count)} servos; it takes ${formatCount(limit)}.`,
  tooManyFrames: ({ count, limit }) =>
    `${formatCount(count)} frames are needed; the board takes ${formatCount(limit)}. Allow a larger error, or shorten the group.`,
  tooShort: ({ servo, frameId, leastMs }, group, nameOf) =>
    `${nameOf(servo)} in frame ${frameNumber(group, frameId)}: no time to get there; the board needs ${formatMs(leastMs)}.`,
  tooFast: ({ servo, atMs, degreesPerS, limit }, _group, nameOf) =>
    `${nameOf(servo)} before ${formatSeconds(atMs)}: ${formatWhole(degreesPerS)}° a second; servos follow up to ${formatWhole(limit)}°. Give it more time.`,
  deviation: ({ servo, atMs, units, limit }, { unit }, nameOf) =>
    `${nameOf(servo)} at ${formatSeconds(atMs)} would be off by ${formatPosition(Math.round(units), unit)}; ${formatPosition(limit, unit)} is allowed. Give it more time, or allow a larger error.`,
};

export const compileWords = {
  fits: 'Fits',
  fitsNot: 'Does not fit',
  ofOther: 'For another board',
  problem: (problem: CompileProblem, group: ActionGroup, nameOf: NameOf): string =>
    (problems[problem.kind] as Said<CompileProblem>)(problem, group, nameOf),
};
