// Words about files of action groups, in Chinese.

import type { Loss, LossCode } from '#shared/actions/files/losses.ts';
import type { Misfit, MisfitCode } from '#shared/actions/files/fit.ts';
import type { Problem, ProblemCode, Remark, RemarkCode } from '#shared/actions/files/reading.ts';
import type { SaveFormat } from '#shared/actions/files/writeGroupFile.ts';
import { UNIT_RANGE } from '#shared/actions/files/units.ts';
import type { Range } from '#shared/protocol/families.ts';
import type { Words } from '../en/whole.ts';
import type { PositionUnit } from '../numbers.ts';
import { formatSeconds, formatWhole, unitSymbol } from './numbers.ts';

/** What a program said of the file is English, for whoever writes such files: left out. */
export const PROBLEMS: Readonly<Record<ProblemCode, (found: string) => string>> = {
  empty: () => '文件是空的。',
  tooLarge: () => '文件超过8 MB，动作组不会这么大。',
  unreadable: () => '浏览器无法读取它，可能是一个文件夹。',
  unknownFormat: () => '这里打不开这种格式。',
  notOurs: () => '这不是 Servodeck 的这种文件，或者文件已损坏。',
  otherVersion: () => '它是由另一个版本的 Servodeck 写的。',
  badValue: (found) => `${found} 的值不合理。`,
  sameNumber: (found) => `${found === '' ? '' : `${found}：`}其中两个部分的编号相同。`,
  sameKey: (found) => `两个按钮用了同一个键，${found}。`,
  servoTwice: (found) => `${found}：同一个舵机出现了两次。`,
  servoOrder: (found) => `第${found}帧：舵机没有按编号从小到大排列，或者有重复。`,
  poseMissing: () => '它提到的姿态不在文件里。',
  noFrames: () => '里面没有帧。',
  tooManyFrames: (found) => `它有${found}帧，动作组最多10000帧。`,
  cutShort: () => '文件不完整，后面缺了一部分。',
  badMove: (found) => `“${found}”不是舵机和位置，应像“#1 P1500”这样。`,
  badTime: (found) => `“${found}”不是时间，应是0到65535的整数毫秒。`,
  badServo: (found) => `“${found}”不是舵机编号，应在0到255之间。`,
  badPosition: (found) => `“${found}”不是位置，应是0到65535的整数。`,
  unpaired: (found) => `每帧要有一个 ID、一个 Move 和一个 Time，这里有 ${found}。`,
  notClosed: (found) => `<${found}> 没有结束。`,
  encrypted: () => '文件已加密。可以用写它的软件不加密地再存一次。',
  unknownTag: (found) => `不认识它的类型“${found}”。`,
  noColumn: (found) => `缺少 ${found} 列。`,
  columnTwice: (found) => `${found} 列出现了两次。`,
  cellCount: (found) => `单元格的数量和第一行不同：${found}。`,
  noTable: (found) => `数据库里没有 ${found} 表。`,
  damagedDatabase: () => '无法读取这个数据库。',
};

const REMARKS: Readonly<Record<RemarkCode, (found: string) => string>> = {
  otherEncoding: (found) => `文字不是 UTF-8 编码，已按 ${found} 读取。`,
  unknownType: (found) => `不认识舵机类型“${found}”。`,
  columnIgnored: (found) => `${found} 列没有读取。`,
  indexOrder: () => '各行保持文件里的顺序，虽然编号的顺序不同。',
  servoTwice: (found) => `${found}号舵机出现了两次，以后一个位置为准。`,
  bytesBehind: (found) => `最后一帧后面的${found}个字节没有读取。`,
  nameCut: () => '名字只保留了64个字符。',
};

function placed({ place }: Problem | Remark, sentence: string): string {
  if (place === null) return sentence;
  return 'line' in place
    ? `第${formatWhole(place.line)}行：${sentence}`
    : `第${formatWhole(place.frame)}帧：${sentence}`;
}

const span = ({ min, max }: Range): string =>
  min === max ? formatWhole(min) : `${formatWhole(min)}到${formatWhole(max)}`;

const MISFITS: Readonly<Record<MisfitCode, (misfit: Misfit) => string>> = {
  unit: () => '它是为另一种单位的控制板做的。',
  frameCount: ({ values, allowed }) =>
    `控制板最多存${formatWhole(allowed.max)}帧，它有${formatWhole(values.max)}帧。`,
  slot: ({ values, allowed }) => `控制板的槽位是${span(allowed)}，没有${formatWhole(values.max)}。`,
  duration: ({ values, allowed }) => `时间是${span(values)}毫秒，控制板接受${span(allowed)}毫秒。`,
  servoCount: ({ values, allowed }) =>
    `同时有${span(values)}个舵机，控制板最多接受${formatWhole(allowed.max)}个。`,
  servo: ({ servo, allowed }) => `${formatWhole(servo ?? 0)}号舵机不存在，舵机编号是${span(allowed)}。`,
  position: ({ servo, values, allowed }) =>
    `${formatWhole(servo ?? 0)}号舵机要到${span(values)}，它只能在${span(allowed)}之间。`,
};

/** So many frames are named; the others are counted. */
const NAMED_FRAMES = 5;

function inFrames(frames: readonly number[]): string {
  const [first] = frames;
  if (first === undefined || first === 0) return '';
  const named = frames.slice(0, NAMED_FRAMES).map(formatWhole).join('、');
  return frames.length > NAMED_FRAMES ? `第${named}等${formatWhole(frames.length)}帧。` : `第${named}帧。`;
}

const LOSSES: Readonly<Record<LossCode, string>> = {
  easings: '不保存缓动，运动变成匀速。',
  marks: '不保存备注、颜色和标记。',
  about: '不保存标签和机器人的名字。',
  times: '不保存播放次数。',
  completed: '正在途中的舵机会补上当时的位置。',
  lacking: '舵机在第一次出现之前没有位置，厂家的软件可能需要它。',
};

const FORMATS: Readonly<Record<SaveFormat, { readonly name: string; readonly about: string }>> = {
  json: { name: 'Servodeck', about: '保存全部内容，以后可以接着编辑。' },
  xml: { name: 'XML', about: '用于 uHand 和 LeArm 的软件。uHand 只打开每帧六个舵机的文件。' },
  d6a: { name: '.d6a', about: '用于 TonyPi、SpiderPi、MasterPi、ArmPi 和 AiNex。' },
  rob: { name: '.rob', about: '用于总线舵机控制软件，1到40号总线舵机。' },
  csv: { name: 'CSV', about: '用于电子表格，每帧一行。' },
  python: { name: 'Python', about: '通过串口播放的程序，需要 pyserial。' },
  arduino: { name: 'Arduino', about: '引脚接地时播放的程序。' },
};

const UNITS: Readonly<Record<PositionUnit, string>> = {
  us: '脉宽，用于 PWM 舵机',
  steps: '步数，用于总线舵机',
};

export const fileWords: Words['files'] = {
  title: '文件',
  button: (opened, refused) =>
    [
      '文件',
      ...(opened === 0 ? [] : [`已打开${formatWhole(opened)}个`]),
      ...(refused === 0 ? [] : [`${formatWhole(refused)}个没有打开`]),
    ].join('，'),
  open: '打开',
  choose: '选择文件',
  hint: 'XML、.rob、.d6a、CSV 和 Servodeck 自己的文件。也可以拖到这里。',
  list: '已打开的文件',
  reading: '正在读取文件',
  readSoFar: (done, total) => `已读取${formatWhole(done)}个，共${formatWhole(total)}个文件`,
  unread: (count) => `已取消，有${formatWhole(count)}个文件没有读取。`,
  taking: '正在放入动作库',
  takenSoFar: (done, total) => `已放入${formatWhole(done)}个，共${formatWhole(total)}个动作组`,
  cancel: '取消',
  refused: (file) => `没有打开 ${file}。`,
  about: (frames, durationMs, servos) =>
    `${formatWhole(frames)}帧，${formatSeconds(durationMs)}，${formatWhole(servos)}个舵机`,
  slot: (slot) => `用于槽位${formatWhole(slot)}`,
  from: (file) => `来自 ${file}`,
  take: (name) => `打开${name}`,
  takeVerb: '打开',
  takeAll: (count) => `全部打开（${formatWhole(count)}个）`,
  takeAllHint: (name) => `随后显示${name}，其余的放入动作库。`,
  inLibrary: (count) => `另有${formatWhole(count)}个动作组已放入动作库。`,
  taken: (name, frames) => `已打开${name}，${formatWhole(frames)}帧。`,
  step: (name) => `打开${name}`,
  drop: (file) => `从列表中去掉 ${file}`,

  askUnit: '文件没有说明位置的单位：',
  unit: (unit) => UNITS[unit],
  meaning: (unit, { positions, outside }) => {
    const range = `${span(UNIT_RANGE[unit])} ${unitSymbol(unit)}`;
    if (positions === null) return range;
    const fit = outside === 0 ? '全部合适' : `${formatWhole(outside)}个不合适`;
    return `${range}。这里是${span(positions)}，${fit}。`;
  },
  forBoard: (board) => `为${board}编写。没有连接控制板时，以机器人设置里的为准。`,
  convert: (to) => (to === 'steps' ? '换算成步数：（微秒 − 500）÷ 2，取整' : '换算成微秒：步数 × 2 + 500'),

  problem: (problem) => placed(problem, PROBLEMS[problem.code](problem.found)),
  remark: (remark) => placed(remark, REMARKS[remark.code](remark.found)),
  moreRemarks: (count) => `另有${formatWhole(count)}条类似的说明。`,
  misfits: '以下内容不适合当前机器人，仍按原样打开：',
  misfit: (misfit) => `${MISFITS[misfit.code](misfit)}${inFrames(misfit.frames)}`,

  save: '另存为',
  nothing: '还没有可以保存的帧。',
  format: (format) => FORMATS[format].name,
  formatAbout: (format) => FORMATS[format].about,
  loss: ({ code, frames }: Loss) => `${LOSSES[code]}${inFrames(frames)}`,
  saveVerb: (name) => `保存 ${name}`,
  notSaved: '没有保存，因为以下内容不合适：',
  saveFailed: '无法生成这个文件。',
};
