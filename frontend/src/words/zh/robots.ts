// Words about robots, in Chinese.

import type { Limb, ReadyRobotId, RobotNames, Role } from '#shared/actions/robot/readyRobots.ts';
import type { ServoFlaw } from '#shared/actions/robot/robot.ts';
import type { RobotFileFlaw } from '#shared/actions/robot/robotText.ts';
import type { Range } from '#shared/protocol/families.ts';
import type { Words } from '../en/whole.ts';
import { libraryWords } from './library.ts';
import { formatNames, formatWhole } from './numbers.ts';
import { FIELD_TAKES, inList } from './robotFields.ts';

const READY: Readonly<Record<ReadyRobotId, string>> = {
  arm: '机械臂，6个舵机',
  hand: '机械手，6个舵机',
  humanoid16: '人形机器人，16个舵机',
  humanoid18: '人形机器人，18个舵机',
  hexapod18: '六足机器人，18个舵机',
  plain6: '普通，6个舵机',
  plain16: '普通，16个舵机',
  plain24: '普通，24个舵机',
  plain32: '普通，32个舵机',
};

const NAMES: Readonly<Record<ReadyRobotId, string>> = {
  ...{ arm: '机械臂', hand: '机械手', hexapod18: '六足机器人' },
  ...{ humanoid16: '人形机器人', humanoid18: '人形机器人' },
  ...{ plain6: '普通', plain16: '普通', plain24: '普通', plain32: '普通' },
};

const ROLE_NAMES: Readonly<Record<Role, string>> = {
  gripper: '夹爪',
  wristRoll: '腕部旋转',
  wrist: '腕部',
  elbow: '肘部',
  shoulder: '肩部',
  base: '底座',
  thumb: '拇指',
  index: '食指',
  middle: '中指',
  ring: '无名指',
  little: '小指',
  foot: '脚',
  ankle: '踝部',
  knee: '膝部',
  thigh: '大腿',
  hip: '髋部',
  shoulderTurn: '肩部旋转',
  upperArm: '上臂',
  hand: '手',
  coxa: '髋节',
  femur: '股节',
  tibia: '胫节',
  servo: '舵机',
};

const LIMB_NAMES: Readonly<Record<Limb, string>> = {
  leftArm: '左臂',
  rightArm: '右臂',
  leftLeg: '左腿',
  rightLeg: '右腿',
  frontLeft: '左前腿',
  middleLeft: '左中腿',
  rearLeft: '左后腿',
  frontRight: '右前腿',
  middleRight: '右中腿',
  rearRight: '右后腿',
};

function robotNames(id: ReadyRobotId): RobotNames {
  return {
    robot: NAMES[id],
    role: (role, servo) => (role === 'servo' ? `${formatWhole(servo)}号舵机` : ROLE_NAMES[role]),
    limb: (limb) => LIMB_NAMES[limb],
  };
}

function flawText(flaw: RobotFileFlaw): string {
  switch (flaw.code) {
    case 'notOurs':
      return '这不是 Servodeck 的机器人文件';
    case 'otherVersion':
      return '它是由另一个版本的 Servodeck 写的';
    case 'field':
      return `${inList(flaw.of)}“${flaw.field}”应是${FIELD_TAKES[flaw.field]}`;
    case 'strangeField':
      return `${inList(flaw.of)}没有“${flaw.field}”这一项`;
    case 'servoTwice':
      return `${formatWhole(flaw.servo)}号舵机出现了两次`;
    case 'alarmNotBelow':
      return `报警电压${formatWhole(flaw.alarmMv)} mV 不低于提醒电压${formatWhole(flaw.warnMv)} mV`;
    case 'servo':
      return `${flaw.servo.name}（${formatWhole(flaw.servo.servo)}号舵机）${servoFlawText(flaw.flaw)}`;
  }
}

function servoFlawText(flaw: ServoFlaw): string {
  switch (flaw.code) {
    case 'number':
      return `的编号应在${rangeText(flaw.range)}之间`;
    case 'minNotBelowMax':
      return `的最低位置${formatWhole(flaw.min)}不低于最高位置${formatWhole(flaw.max)}`;
    case 'home':
      return `的初始位${formatWhole(flaw.value)}不在${rangeText(flaw.range)}之间`;
    case 'trim':
      return `的微调${formatWhole(flaw.value)}不在${rangeText(flaw.range)}之间`;
    case 'beyondBoard':
      return `加上微调后超出控制板的范围${rangeText(flaw.range)}`;
    case 'noMirror':
      return `的镜像，${formatWhole(flaw.mirror)}号舵机，不存在`;
  }
}

const rangeText = ({ min, max }: Range): string => `${formatWhole(min)}到${formatWhole(max)}`;

export const robotWords: Words['robots'] = {
  notSaved: '浏览器不能保存机器人；关闭页面前它们一直在。',
  unreadable: '已保存的机器人无法读取。原文件已完好地另存。',
  flaw: (flaw) => `这样不行：${flawText(flaw)}。`,
  notKept: (code, detail) =>
    code === 'tooLarge'
      ? '机器人连同姿态和按钮太大，库里放不下。它只留在本浏览器里；请删掉一些姿态。'
      : `机器人尚未存入库：${libraryWords.problem(code, detail)}稍后会再试。`,
  otherVersion: (name) => `${name}（另一版本）`,
  conflict: (name, copy) => `“${name}”同时被别人改过。您的版本另存为“${copy}”。`,
  handedIn: (names) =>
    `网关现在保存机器人，所有屏幕都能看到。此浏览器里的机器人已加入列表：${formatNames(names)}。`,
  onlyLooking: '观看者看到的是别人描述的机器人，不能更改。',
  othersHands: (driver) => `${driver}正在控制：使用哪个机器人以及它的限位，只能由控制者更改。`,
  copyOf: (name) => `${name}（副本）`,
  numbered: (name, number) => `${name}（${formatWhole(number)}）`,
  steps: {
    duplicate: '复制机器人',
    remove: '删除机器人',
    add: '新机器人',
    import: '导入机器人',
    elsewhere: '另一屏幕上的更改',
  },
  called: ({ name, group }) => (group === '' ? name : `${name}（${group}）`),
  absent: (servo) => `${formatWhole(servo)}号舵机，这台机器人没有`,
  title: '机器人',
  button: (name) => `机器人：${name}`,
  own: '已描述的机器人',
  place: {
    gateway: '由网关保存：所有屏幕都能看到。',
    browser: '保存在此浏览器中。',
  },
  everyones: '在控制板上，对所有人有效',
  count: (servos) => `${formatWhole(servos)}个舵机`,
  atHand: '使用中',
  use: (name) => `使用${name}`,
  useVerb: '使用',
  otherBoard: (board) => `等待它的控制板：${board}`,
  calibrate: '校准',
  edit: '编辑',
  duplicate: '复制',
  export: '导出',
  remove: '删除',
  removeNamed: (name) => `删除${name}`,
  fresh: '新机器人',
  freshHint: (board) => `适合${board}的预设机器人。添加一个，然后校准。`,
  ready: READY,
  names: robotNames,
  add: (name) => `添加${name}`,
  import: '导入机器人文件',
  importHint: '也可以拖到这里。',
  imported: (name) => `${name}已导入。`,
  importedElsewhere: (name, board) => `${name}已导入，等待连接它的控制板：${board}。`,
  notImported: (file, problem) => `${file} 没有导入：${flawText(problem)}。`,
  back: '所有机器人',
};
