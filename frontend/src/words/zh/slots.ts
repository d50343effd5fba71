// Words about the board's slots: what is in them, as far as anybody can know, and what plays them.

import type { SlotFate } from '#shared/actions/slots/slotBook.ts';
import type { PadButton } from '#shared/protocol/families.ts';
import type { Words } from '../en/whole.ts';
import { formatCount, formatNames, formatRoughly, formatSeconds, formatWhole } from './numbers.ts';

const slotName = (slot: number): string => `槽位${formatWhole(slot)}`;
const frameCount = (count: number): string => `${formatCount(count)}帧`;
const place = (position: number | null): string => (position === null ? '不动' : formatWhole(position));

const buttons: Readonly<Record<PadButton, string>> = {
  ...{ start: 'START', up: '上', down: '下', left: '左', right: '右' },
  ...{ triangle: '三角', cross: '叉', square: '方块', circle: '圆圈' },
  ...{ l1: 'L1', r1: 'R1', l2: 'L2', r2: 'R2' },
};

const about: Readonly<Record<SlotFate, string>> = {
  arriving: '正在下载到这里',
  broken: '已损坏：下载没有完成',
  same: '这个动作组，与现在一致',
  older: '这个动作组的旧版本',
  other: '不是这个动作组现在的样子',
  empty: '全部擦除后是空的',
  unknown: '未知：没有从这里下载过',
};

const holds = (fate: SlotFate, name: string): string =>
  ({
    arriving: '正在下载。',
    broken: '下载没有完成。运行前请重新下载。',
    same: '存有这个动作组，是现在的版本。',
    older: '存有这个动作组的旧版本。',
    other: `存有${name === '' ? '另一个动作组' : `“${name}”`}，不是这个动作组现在的样子。`,
    empty: '全部擦除以后一直是空的。',
    unknown: '里面有什么未知；控制板不能读取。',
  })[fate];

export const slotWords: Words['slots'] = {
  title: '控制板的槽位',
  open: '槽位',
  map: '槽位一览',
  intro: '控制板不能读取。这里列出的是从这里、或由别人经同一网关下载的内容；之后可能被别的程序改过。',
  name: slotName,
  cell: (slot, fate, name) =>
    name === undefined ? `${slotName(slot)}：${about[fate]}` : `${slotName(slot)}：${name}。${about[fate]}`,
  about: (fate) => about[fate],
  holds,
  inBar: (fate, name) =>
    ({
      arriving: '正在下载',
      broken: '已损坏',
      same: '存有这个动作组',
      older: '存有旧版本',
      other: name === '' ? '存有另一个动作组' : `存有“${name}”`,
      empty: '空',
      unknown: '未知',
    })[fate],
  badge: {
    arriving: '下载中',
    broken: '已损坏',
    same: '最新',
    older: '旧版本',
    other: '已存',
    empty: '空',
    unknown: '未知',
  },
  trigger: (trigger) =>
    trigger.kind === 'pad'
      ? `由无线手柄的${buttons[trigger.button]}键播放`
      : trigger.kind === 'select'
        ? '由无线手柄的 SELECT 加一个键播放'
        : trigger.kind === 'key'
          ? '由控制板上的按键播放'
          : `槽位${formatWhole(trigger.after)}结束后自动播放`,
  triggerShort: (trigger) =>
    trigger.kind === 'pad'
      ? buttons[trigger.button]
      : { select: 'SELECT', key: '按键', chain: '接续' }[trigger.kind],
  triggerInBar: (trigger) =>
    trigger.kind === 'pad'
      ? `手柄按键：${buttons[trigger.button]}`
      : trigger.kind === 'chain'
        ? `接在槽位${formatWhole(trigger.after)}之后`
        : { select: '手柄 SELECT 加一个键', key: '控制板上的按键' }[trigger.kind],
  stored: (name, when, count, durationMs, version) =>
    `${name === '' ? '无名称' : name}，${frameCount(count)}，${formatSeconds(durationMs)}，下载于${when}，版本${version}`,
  storedByOthers: (name, by, when, version, size) =>
    [name === '' ? '无名称' : name, size, by === '' ? '由别处下载' : `由${by}下载`, when, `版本${version}`]
      .filter((part) => part !== null)
      .join('，'),
  notInLibrary: '库里没有这个版本：不能从这里比较，也不能从这里恢复。',
  replaceTitle: (slots) =>
    slots.length === 1
      ? `${slotName(slots[0] ?? 0)}里是另一个动作组`
      : `${formatCount(slots.length)}个槽位里是别的动作组`,
  replaceText: (slot, held, name, isInLibrary, trigger) =>
    [
      `“${name}”会替换控制板槽位${formatWhole(slot)}里的${held === '' ? '动作组' : `“${held}”`}。`,
      isInLibrary
        ? `${held === '' ? '那个动作组' : `“${held}”`}仍在库里。`
        : `${held === '' ? '那个动作组' : `“${held}”`}不在库里，会丢失。`,
      ...(trigger === '' ? [] : [`${trigger}。`]),
    ].join(''),
  replaceLeave: '保持原样',
  replaceFree: (slots) =>
    slots.length === 1
      ? `用槽位${formatWhole(slots[0] ?? 0)}（空闲）`
      : `用槽位${formatNames(slots.map((slot) => formatWhole(slot)))}（空闲）`,
  replace: '替换',
  run: '运行',
  compare: '比较',
  same: '控制板上的副本与这个页面上的动作组相同。',
  lengths: (counts, durationsMs) =>
    `控制板上${frameCount(counts[0])}，${formatSeconds(durationsMs[0])}；这里${frameCount(counts[1])}，${formatSeconds(durationsMs[1])}。`,
  firstDifferent: (frame) => `从第${formatWhole(frame)}帧开始不同。`,
  differs: (name, onBoard, here) => `${name}：控制板上${place(onBoard)}，这里${place(here)}`,
  willGo: (groups) =>
    `之后可以恢复：${formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`))}。`,
  notRestored: (groups) =>
    `不能恢复，因为库里没有下载的那个版本：${formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`.trim()))}。`,
  restoreAll: (count) => `全部恢复（${formatCount(count)}）`,
  restoreHint: '重新下载上次擦除的内容',
  job: (done, count) => `${formatCount(done)}/${formatCount(count)}个动作组`,
  several: {
    open: '下载多个',
    title: '下载多个动作组',
    hint: '依次下载，每个放进自己的槽位。',
    list: '库里的动作组',
    all: (count) => `全部${formatCount(count)}个`,
    about: (count, durationMs) => `${frameCount(count)}，${formatSeconds(durationMs)}`,
    slotOf: (name) => `${name}的槽位`,
    noFrame: '还没有帧。',
    sameSlot: (slot) => `${slotName(slot)}被用了两次。`,
    total: (count, frames, downloadMs) =>
      `${formatCount(count)}个动作组，控制板上${frameCount(frames)}，下载约${formatRoughly(downloadMs)}`,
    cannot: (count) => `有${formatCount(count)}个动作组不能下载；原因写在各自旁边。`,
    none: '勾选要下载到控制板的动作组。',
    download: '下载这些',
    back: '回到单个槽位',
  },
  notSaved: '浏览器不能保存控制板上有什么；关闭页面前它一直知道。',
};
