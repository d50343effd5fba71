// Words about which board this is, in Chinese.

import type { Family } from '#shared/protocol/families.ts';
import type { Evidence } from '#shared/session/identity.ts';
import type { Words } from '../en/whole.ts';
import { formatCount, formatVolts, formatWhole, unitSymbol } from './numbers.ts';

export const identityWords: Words['identity'] = {
  title: { none: '还没有机器人', which: '这是哪种控制板？', changed: '应答的是另一种控制板' },
  unasked: '接好机器人并打开电源，然后选择它的串口。这不会让它动。',
  choosePort: '选择串口',
  beforehand: '预先说明是哪种控制板',
  asking: '正在询问控制板的型号。什么都不会动。',
  evidence: '它的应答',
  evidenceOf,
  summary,
  likely: '会这样应答的控制板',
  about: (family) =>
    `${DESCRIBED[family.id]}${formatWhole(family.position.min)}–${formatWhole(family.position.max)}${unitSymbol(family.unit)}`,
  again: '再问一次',
  againHint: '三个无害的问题；在 LeArm 上会结束正在运行的动作组。',
  others: '其他控制板',
  silentHint: '这些控制板总会应答点什么。只有您的控制板现在没开机时才选它：会一直等到它开机。',
  ruledOut: (names) => (names.length === 0 ? '' : `根据应答排除：${names.join('、')}。`),
  nickname: '这块控制板的名字',
  nicknameHint: '例如“桌上的机械臂”。保存在这个浏览器里。',
  takenFor: (name) => `认作：${name}`,
  change: '更换控制板',
  thisBoard: '当前控制板',
  notThis: '重新询问',
  version: (version) => `固件版本${formatWhole(version)}`,
  offsets: (offsets) => {
    const set = offsets.filter(({ offset }) => offset !== 0);
    const list = set.map(({ servo, offset }) => `${formatWhole(servo)}号舵机是${formatWhole(offset)}`);
    return set.length === 0 ? '所有舵机都没有偏差' : `偏差：${list.join('，')}`;
  },
  askDetails: '询问版本和偏差',
  unproven: '这种控制板不回答任何问题，所以无法证实。',
};

/** By family id; the range is added. */
const DESCRIBED: Readonly<Record<Family['id'], string>> = {
  unknown: '',
  doc: '按协议文档：可存动作组，最多32个舵机。',
  'openarm-old': '机械臂或机械手，运行动作组时不应答。',
  'openarm-new': '机械臂或机械手，6个舵机，CH340 线。',
  'lsc-6': '6路输出。',
  'lsc-16': '16路输出。',
  'lsc-24': '24路输出。',
  'lsc-32': '32路输出。',
  'bus-ctrl': '串联的串行总线舵机。',
  xarm: '6个总线舵机的机械臂。',
  'learm-esp32': '2025年，ESP32 主控，PWM 舵机。',
  'learm-esp32-bus': '2025年，ESP32 主控，总线舵机。',
};

const SILENT: Readonly<Record<string, string>> = {
  readBattery: '它没有告诉电池电压。',
  readVersion: '它没有告诉版本。',
  readPositions: '它没有告诉1号舵机的位置。',
};

function evidenceOf(evidence: Evidence): string {
  switch (evidence.kind) {
    case 'silent':
      return SILENT[evidence.question] ?? '';
    case 'echoed':
      return '我们自己的问题被送了回来。';
    case 'noise':
      return `有${formatCount(evidence.byteCount)}个字节不是数据包。`;
    case 'answered':
      return answerOf(evidence.report);
  }
}

function answerOf(report: Extract<Evidence, { kind: 'answered' }>['report']): string {
  switch (report.kind) {
    case 'battery':
      return `它告诉了电池电压：${formatVolts(report.batteryMv)}。`;
    case 'version':
      return `它告诉了版本：${formatWhole(report.version)}，${report.unit === 'us' ? 'PWM 舵机' : '总线舵机'}。`;
    case 'positions':
      return `它告诉了舵机的位置：${report.positions.map(({ position }) => formatWhole(position)).join('、')}。`;
    default:
      return '它应答了。';
  }
}

function summary(evidence: readonly Evidence[]): string {
  const has = (kind: Evidence['kind']): boolean => evidence.some((one) => one.kind === kind);
  if (has('echoed'))
    return '这个串口把发出的内容原样送了回来。请检查转接器与控制板的接线：RX 接 TX，TX 接 RX。';
  if (has('answered')) return '它应答了。请选择您的控制板；Servodeck 会记住它，并在每次连接时核对。';
  if (has('noise'))
    return '有东西在发送，但不是数据包。LeArm 启动时就是这样：等它准备好，按一下 K1 键进入 PC 模式，然后再问一次。';
  return '没有应答。uHand 和 OpenArm 控制板从不应答；如果是其中一种，请选择它。其他控制板可能没开机、没接好，或者正在听手机 App：在 LeArm 上按一下 K1，然后再问一次。';
}
