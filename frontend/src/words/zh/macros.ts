// Words about the page of buttons, in Chinese.

import type { Words } from '../en/whole.ts';
import { PROBLEMS } from './files.ts';
import { formatMs, formatSeconds, formatWhole } from './numbers.ts';
import { timesWords } from './packets.ts';

const KIOSK_HOLD_S = 2;

export const macroWords: Words['macros'] = {
  title: '按钮',
  page: { label: '页面', work: '控制', buttons: '按钮' },
  list: '按钮',
  noButtons: '还没有按钮',
  noButtonsHint:
    '一个按钮可以让机器人到某个姿态、播放一个槽位，或依次做几件事。姿态里也有“做成按钮”。谁都能用这个页面。',
  notSaved: '浏览器不能保存按钮；关闭页面前它们一直在。',
  unreadable: ({ code, at }) => `已保存的按钮无法读取。原文件已完好地另存。${PROBLEMS[code](at)}`,
  empty: '这个按钮还没有步骤。',

  edit: '编辑按钮',
  add: '添加按钮',
  newName: (number) => `按钮${formatWhole(number)}`,
  select: '选择一个按钮来修改。',
  selected: (name) => `修改${name}`,
  name: '按钮的名字',
  colour: '颜色',
  colours: {
    slate: '石板灰',
    indigo: '靛蓝',
    violet: '紫罗兰',
    plum: '梅红',
    clay: '陶土色',
    olive: '橄榄绿',
  },
  key: '按键',
  setKey: '设置按键',
  pressKey: '请按一个键',
  noKey: '去掉按键',
  keyUnfit: '按钮只能用字母、数字或符号键，不能同时按 Ctrl、Alt 或 Command。',
  keyTaken: (key, from) => `${key.toUpperCase()}原来是“${from}”的按键，它现在没有按键了。`,
  keyed: (name, key) => (key === null ? name : `${name}，按键 ${key.toUpperCase()}`),
  earlier: '按钮前移',
  later: '按钮后移',
  delete: '删除按钮',
  moved: (from, to) => `第${formatWhole(from)}个按钮现在是第${formatWhole(to)}个`,

  steps: '步骤',
  addPose: '姿态',
  addSlot: '槽位',
  addWait: '等待',
  addStep: '添加步骤',
  stepPose: (number) => `第${formatWhole(number)}步的姿态`,
  stepMs: (number) => `第${formatWhole(number)}步的时间，单位毫秒`,
  stepSlot: (number) => `第${formatWhole(number)}步的槽位`,
  stepTimes: (number) => `第${formatWhole(number)}步的次数`,
  times: '×',
  stepUp: (number) => `第${formatWhole(number)}步上移`,
  stepDown: (number) => `第${formatWhole(number)}步下移`,
  stepDelete: (number) => `删除第${formatWhole(number)}步`,
  stepAbout: (step, pose) => {
    if (step.kind === 'pose')
      return pose === '' ? formatMs(step.durationMs) : `${pose}，${formatMs(step.durationMs)}`;
    if (step.kind === 'slot') return `槽位${formatWhole(step.slot)}，${timesWords(step.times)}`;
    return `等待${formatSeconds(step.waitMs)}`;
  },
  stepCount: (count) => `${formatWhole(count)}步`,
  atWork: (step, count) => `第${formatWhole(step)}步，共${formatWhole(count)}步。按下结束`,

  kiosk: '展示模式',
  kioskHint: `只显示这些按钮和“停止”，刷新页面后也一样。要退出，请按住左下角的按钮${formatWhole(KIOSK_HOLD_S)}秒。`,
  leaveKiosk: `按住${formatWhole(KIOSK_HOLD_S)}秒退出`,

  edits: {
    add: (name) => `添加${name}`,
    delete: (name) => `删除${name}`,
    move: (name) => `移动${name}`,
    rename: (name) => `重命名${name}`,
    colour: (name) => `${name}的颜色`,
    key: (name) => `${name}的按键`,
    steps: (name) => `${name}的步骤`,
  },
};
