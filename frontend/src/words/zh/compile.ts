// Words about what a group becomes on the board: whether it fits, how far off it is, what keeps it from going there.

import type { CompileProblem } from '#shared/actions/group/compileReport.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Words } from '../en/whole.ts';
import {
  formatCount,
  formatDegrees,
  formatMs,
  formatPosition,
  formatRoughly,
  formatSeconds,
  formatWhole,
  unitSymbol,
} from './numbers.ts';

type NameOf = (servo: number) => string;
type Said<Problem> = (problem: Problem, group: ActionGroup, nameOf: NameOf) => string;

type ProblemWords = {
  readonly [K in CompileProblem['kind']]: Said<Extract<CompileProblem, { kind: K }>>;
};

const frameNumber = ({ frames }: ActionGroup, id: number): string =>
  `第${formatWhole(frames.findIndex((frame) => frame.id === id) + 1)}帧`;

const problems: ProblemWords = {
  unit: ({ group, board }) => `动作组的单位是${unitSymbol(group)}，控制板用${unitSymbol(board)}。`,
  servo: ({ servo, min, max }, _group, nameOf) =>
    `${nameOf(servo)}：控制板只接受${formatWhole(min)}到${formatWhole(max)}号舵机。`,
  position: ({ servo, frameId, position, min, max }, group, nameOf) =>
    `${nameOf(servo)}，${frameNumber(group, frameId)}：${formatWhole(position)}超出范围；允许${formatWhole(min)}到${formatWhole(max)}。`,
  tooManyServos: ({ frame, count, limit }) =>
    `控制板上的第${formatWhole(frame + 1)}帧要动${formatCount(count)}个舵机；最多${formatCount(limit)}个。`,
  tooManyFrames: ({ count, limit }) =>
    `需要${formatCount(count)}帧；控制板最多${formatCount(limit)}帧。请允许更大的误差，或缩短动作组。`,
  tooShort: ({ servo, frameId, leastMs }, group, nameOf) =>
    `${nameOf(servo)}，${frameNumber(group, frameId)}：没有时间到达；控制板需要${formatMs(leastMs)}。`,
  tooFast: ({ servo, atMs, degreesPerS, limit }, _group, nameOf) =>
    `${nameOf(servo)}，${formatSeconds(atMs)}之前：每秒${formatWhole(degreesPerS)}°；舵机最多跟得上${formatWhole(limit)}°。请给它更多时间。`,
  deviation: ({ servo, atMs, units, limit }, { unit }, nameOf) =>
    `${nameOf(servo)}在${formatSeconds(atMs)}会偏差${formatPosition(Math.round(units), unit)}；允许${formatPosition(limit, unit)}。请给它更多时间，或允许更大的误差。`,
};

export const compileWords: Words['compile'] = {
  label: '在控制板上',
  error: '允许偏差',
  step: '更改允许偏差',
  errorField: '控制板上允许的最大误差',
  frames: (count, limit) => `${formatCount(count)}/${formatCount(limit)}帧`,
  bytes: (bytes) => `${formatCount(bytes)}字节`,
  download: (ms) => `下载约需${formatRoughly(ms)}`,
  exact: '与所写完全一致',
  worst: (units, unit, degrees, name, atMs) =>
    `最多偏差${formatPosition(Math.round(units), unit)}（${formatDegrees(degrees, 1)}）：${name}，${formatSeconds(atMs)}`,
  shifted: (ms) => `关键帧最多移动${formatMs(ms)}：控制板按节拍计时`,
  fits: '放得下',
  fitsNot: '放不下',
  ofOther: '为别的控制板制作',
  stale: '正在计算',
  empty: '还没有可存储的内容。',
  problems: '哪里放不下',
  more: (count) => `还有${formatCount(count)}项`,
  problem: (problem, group, nameOf) =>
    (problems[problem.kind] as Said<CompileProblem>)(problem, group, nameOf),
};
