// Words about posing the robot by hand.

import type { Words } from '../en/whole.ts';
import { formatNames } from './numbers.ts';

export const teachWords: Words['teach'] = {
  teach: '示教',
  hint: '让舵机卸力，用手摆好机器人，再采集读到的姿态',
  title: '用手示教？',
  text: '所有舵机都会卸力，手臂会落下：请扶住它，然后用手转动。页面会不断读取位置并画出来；可以采集帧和姿态，也可以录制。结束时舵机逐个保持在当前位置。',
  confirm: '卸力并示教',
  end: '保持并结束示教',
  on: '正在示教：用手转动舵机并采集，请一直扶住手臂。',
  status: '示教中：请扶住',
  staysReleased: '示教已结束，没有命令舵机保持：请扶住手臂。',
  notHeld: (names) => `${formatNames(names)}没有保持：没有读到位置，或者超出了限位，仍处于卸力状态。`,
};
