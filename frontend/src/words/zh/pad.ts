// Words about driving by pad and keys, in Chinese.

import type { Binding, Input, Side } from '#shared/actions/mapping/mapping.ts';
import type { Words } from '../en/whole.ts';
import { PROBLEMS } from './files.ts';
import { formatMs, formatNames, formatPercent, formatWhole, unitSymbol } from './numbers.ts';

/** As most pads print it; the order is the browser's standard one. */
const BUTTONS: readonly string[] = [
  ...['A', 'B', 'X', 'Y', '左肩键', '右肩键', '左扳机', '右扳机', '返回键', '开始键'],
  ...['左摇杆按下', '右摇杆按下', '方向键上', '方向键下', '方向键左', '方向键右', '主页键'],
];

const AXES: readonly Readonly<Record<Side, string>>[] = [
  { whole: '左摇杆左右', minus: '左摇杆向左', plus: '左摇杆向右' },
  { whole: '左摇杆上下', minus: '左摇杆向上', plus: '左摇杆向下' },
  { whole: '右摇杆左右', minus: '右摇杆向左', plus: '右摇杆向右' },
  { whole: '右摇杆上下', minus: '右摇杆向上', plus: '右摇杆向下' },
];

const SHORT_AXES: readonly string[] = ['左摇杆 ↔', '左摇杆 ↕', '右摇杆 ↔', '右摇杆 ↕'];

const SIDE_SIGN: Readonly<Record<Side, string>> = { whole: '', minus: ' −', plus: ' +' };

/** `KeyQ` is Q, `Digit1` is 1; others are told as browsers call them. */
const keyName = (code: string): string => code.replace(/^(Key|Digit)/u, '');

function inputName(input: Input): string {
  if (input.kind === 'key') return `${keyName(input.code)} 键`;
  if (input.kind === 'button') return BUTTONS[input.index] ?? `按键${formatWhole(input.index)}`;
  return AXES[input.index]?.[input.side] ?? `轴${formatWhole(input.index)}${SIDE_SIGN[input.side]}`;
}

/** A whole stick's way as a sign; null for anything else. */
function shortName(input: Input): string | null {
  if (input.kind !== 'axis' || input.side !== 'whole') return null;
  return SHORT_AXES[input.index] ?? null;
}

/** In its row an input needs its name and direction only. */
function chipText({ input, action }: Binding): string {
  const name = input.kind === 'key' ? keyName(input.code) : (shortName(input) ?? inputName(input));
  if (action.kind !== 'rate') return name;
  const isBothWays = input.kind === 'axis' && input.side === 'whole';
  return isBothWays ? name : `${name} ${action.unitsPerS < 0 ? '−' : '+'}`;
}

export const padWords: Words['pad'] = {
  title: '键盘和手柄',
  drive: '操控',
  driveHint: '关闭时，按键和摇杆都不会让机器人动。手柄上的“停止”始终有效。',
  drivingHint: '按键和摇杆正在控制机器人。松开或离开这个窗口就停下。',
  unreadable: ({ code, at }) => `已保存的键盘和手柄设置无法读取。原文件已完好地另存。${PROBLEMS[code](at)}`,
  notSaved: '浏览器不能保存键盘和手柄设置；关闭页面前它们一直有效。',
  gone: '手柄断开了。操控已关闭。',
  noPad: '没有发现手柄。请按一下手柄上的按键：这样浏览器才会显示它。',
  otherPad: '这个手柄的按键编号不同，图可能对不上。',
  picture: '手柄示意图：亮起的部分正被按住',
  unknown: (servo) => `${servo}不动：不知道它在哪里。请在“键盘和手柄”里让它先慢慢移动一次，或者用它的滑块。`,
  atLimit: (servo, min, max) => `${servo}不能再转：它应在${formatWhole(min)}到${formatWhole(max)}之间。`,
  allUnknown: (names) => `还不知道这些舵机在哪里：${formatNames(names)}。`,
  firstMove: '先慢慢移动一次',
  firstMoveHint: '把还没动过的舵机慢慢移到各自的初始位',

  table: '哪个按键或摇杆做什么',
  stopRow: '停止',
  poseRow: (pose) => `移到${pose}`,
  slotRow: (slot) => `运行槽位${formatWhole(slot)}`,
  none: '还没有',
  edit: (input, row) => `${input}，用于${row}`,
  input: inputName,
  chip: chipText,

  add: '添加按键或摇杆',
  addHint: '按下按键或推动摇杆，然后说明它做什么',
  listening: '正在等待按键或摇杆。按 Esc 放弃。',
  giveUp: '放弃',
  form: (input) => `${input}做什么`,
  does: '作用',
  actions: { rate: '转动舵机', position: '定位舵机', pose: '移到姿态', run: '运行槽位', stop: '停止' },
  servo: '舵机',
  pose: '要移到的姿态',
  slot: '要运行的槽位',
  speedUnit: (unit) => `${unitSymbol(unit)}/秒`,
  speedField: '速度，单位每秒',
  reversed: '方向相反',
  save: '绑定',
  remove: '解除绑定',
  cancel: '取消',
  ready: '常用按键和摇杆',
  readyHint: '用常用按键和摇杆替换全部绑定。撤销可以恢复您自己的。',
  steps: {
    bind: (input) => `绑定${input}`,
    unbind: (input) => `解除${input}的绑定`,
    feel: '摇杆手感',
    ready: '常用按键和摇杆',
  },

  feel: '手感',
  speedPercent: '速度',
  deadZonePercent: '死区',
  curvePercent: '曲线',
  smoothingMs: '平滑',
  percent: (value) => formatPercent(value / 100),
  ms: formatMs,
  plot: '摇杆推动的幅度与得到的速度',

  conflicts: '冲突',
  sameInput: (input, one, other) =>
    one === other ? `${input}两次绑定到${one}。` : `${input}同时绑定到${one}和${other}。`,
  sharedServo: (name) => `${name}既由一个输入定位，又由另一个输入转动；以最后的输入为准。`,
};
