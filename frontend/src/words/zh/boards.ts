// What boards are called in Chinese, where it is not simply their maker's name.

import type { Family } from '#shared/protocol/families.ts';

const NAMES: Readonly<Partial<Record<Family['id'], string>>> = {
  unknown: '未知控制板',
  doc: '通用控制板',
  'openarm-old': 'uHand 2.0 / OpenArm（旧版）',
  'bus-ctrl': '总线舵机控制板',
  'learm-esp32-bus': 'LeArm AI（总线舵机）',
};

export const boardName = ({ id, name }: Pick<Family, 'id' | 'name'>): string => NAMES[id] ?? name;
