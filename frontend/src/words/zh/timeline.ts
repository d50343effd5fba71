// Words of the timeline, in Chinese.

import type { PasteProblem } from '#shared/actions/group/clip.ts';
import type { Words } from '../en/whole.ts';
import { markText, secondsText } from '../instants.ts';
import { formatCount, formatNames, formatMs, formatPercent, formatWhole, unitSymbol } from './numbers.ts';

const keysText = (count: number): string => `${formatCount(count)}个关键帧`;
const formatInstant = (atMs: number): string => `${secondsText(atMs)}秒`;

const signedInstant = (byMs: number): string => `${byMs < 0 ? '−' : '+'}${formatInstant(Math.abs(byMs))}`;

const easings: Words['timeline']['easings'] = {
  linear: '匀速',
  in: '缓入',
  out: '缓出',
  inOut: '缓入缓出',
  hold: '保持',
};

const pasteProblem = (problem: PasteProblem, nameOf: (servo: number) => string): string => {
  switch (problem.kind) {
    case 'unit':
      return `它的位置以${unitSymbol(problem.clip)}计，这个动作组以${unitSymbol(problem.group)}计`;
    case 'tooManyFrames':
      return `${formatCount(problem.count)}帧超过了动作组的上限${formatCount(problem.limit)}帧`;
    case 'position':
      return `${nameOf(problem.servo)}的${formatWhole(problem.position)}超出范围，可用${formatWhole(problem.min)}到${formatWhole(problem.max)}`;
  }
};

export const timelineWords: Words['timeline'] = {
  title: '时间轴',
  grid: '时间轴：纵向是舵机，横向是时间',
  toolbar: '修改时间轴',
  menu: '可做的操作',
  rowAll: '所有舵机',
  noName: (servo) => `${formatWhole(servo)}号舵机`,
  mark: markText,
  instant: formatInstant,
  playhead: '播放头',
  seen: (from, to) => `${formatPercent(from)}到${formatPercent(to)}`,
  minimap: '整个动作组；拖动查看别处',
  easings,
  easing: '缓动',
  colours: { slate: '石板灰', indigo: '靛蓝', violet: '紫罗兰', plum: '梅红', clay: '陶土', olive: '橄榄绿' },
  colour: '颜色',
  noColour: '无颜色',

  key: (row, atMs, position, easing) => `${row}，${formatInstant(atMs)}，${position}，${easings[easing]}`,
  summary: (row, frame, atMs, count) =>
    `${row}，第${formatWhole(frame)}帧，${formatInstant(atMs)}，${keysText(count)}`,
  noKey: (row) => `${row}，没有关键帧`,

  verbs: {
    setKey: '设关键帧',
    editValue: '修改数值',
    remove: '删除关键帧',
    removeTime: '连同时间删除',
    cut: '剪切',
    copy: '复制',
    paste: '粘贴',
    duplicate: '重复关键帧',
    insertTime: '插入时间',
    reverse: '倒转',
    mirror: '左右镜像',
    scaleTime: '缩放时间',
    scaleTimeBack: '从末尾缩放时间',
    scaleAmplitude: '缩放幅度',
    note: '帧的备注',
    marker: '设标记',
    selectAll: '选中所有关键帧',
    selectRow: '选中这一行',
    selectNone: '取消选中',
    zoomIn: '放大',
    zoomOut: '缩小',
    fitAll: '显示全部',
    fitSelection: '显示所选',
    range: '循环所选',
    frameBefore: '上一帧',
    frameAfter: '下一帧',
    keyBefore: '上一个关键帧',
    keyAfter: '下一个关键帧',
    nextMarker: '下一个标记',
  },
  markerVerbs: { marker: '重命名标记', remove: '删除标记' },
  nudge: '微调',
  nudges: {
    earlier: (by) => `提前${by}`,
    later: (by) => `推后${by}`,
    lower: (by) => `调低${by}`,
    higher: (by) => `调高${by}`,
  },
  more: '更多',
  change: '修改',
  look: '选择和查看',
  switches: { snaps: '吸附', ripples: '联动', showsPreview: '轮廓', isTall: '高行' },
  snapsHint: '吸附到帧、关键帧、标记、播放头和控制板的时间步；按住Alt暂停',
  ripplesHint: '改动后面的内容跟着移动',
  previewHint: '在身体图上显示播放头处的姿态。不会移动机器人。',
  tallHint: '留出用手调数值的空间',

  rows: {
    fold: (limb, count) => `${limb}的行，${formatCount(count)}个舵机`,
    select: (row) => `选中${row}的关键帧`,
    tools: (row) => `${row}这一行`,
    menu: '行',
    value: '动作组在播放头处的位置；机器人可能在别处',
    lock: '锁定',
    unlock: '解锁',
    mute: '静默',
    unmute: '取消静默',
    solo: '只播放和修改这一行',
    unsolo: '重新播放和修改所有行',
    arm: '指定录制',
    disarm: '取消录制',
    hide: '隐藏',
    foldAway: '折叠',
    unfold: '展开',
    showHidden: (count) => `显示隐藏的${formatCount(count)}行`,
    locked: '已锁定',
    muted: '已静默',
    armed: '待录制',
  },

  changes: '+10、−=10、*1.2或/2分别改变每一个',
  asks: {
    value: '所选关键帧的位置',
    scaleTime: '这段时间的新长度，百分比',
    scaleTimeBack: '这段时间的新长度，百分比，末尾不动',
    scaleAmplitude: '相对平均值的新幅度，百分比',
    insertTime: '在播放头插入的时间，单位毫秒',
    note: '帧的备注',
    marker: '标记的文字',
  },
  percent: '%',
  newMarker: (number) => `标记${formatWhole(number)}`,

  steps: {
    setKey: '设关键帧',
    move: '移动关键帧',
    value: '关键帧的位置',
    delete: (count) => `删除${keysText(count)}`,
    deleteTime: '删除时间',
    paste: '粘贴关键帧',
    cut: (count) => `剪切${keysText(count)}`,
    duplicate: '重复关键帧',
    reverse: '倒转',
    mirror: '镜像',
    ease: (easing) => easing,
    colour: '帧的颜色',
    note: '备注',
    duration: (frame) => `第${formatWhole(frame)}帧的时间`,
    stretch: '拉伸',
    scaleTime: '缩放时间',
    scaleAmplitude: '缩放幅度',
    insertTime: '插入时间',
    addMarker: '设标记',
    moveMarker: '移动标记',
    renameMarker: '标记',
    deleteMarker: '删除标记',
  },

  draggedKey: (key, byMs, count) =>
    [key, byMs === 0 ? '' : signedInstant(byMs), count < 2 ? '' : keysText(count)]
      .filter((part) => part !== '')
      .join('；'),
  draggedEnd: (frame, durationMs, atMs) =>
    `第${formatWhole(frame)}帧：${formatMs(durationMs)}，到${formatInstant(atMs)}`,
  draggedStretch: (share, lengthMs) => `${formatPercent(share)}，${formatInstant(Math.round(lengthMs))}`,
  draggedMarker: (text, atMs) => `${text}，${formatInstant(atMs)}`,
  draggedRange: (fromMs, toMs) =>
    `${formatInstant(fromMs)}到${formatInstant(toMs)}，长${formatInstant(toMs - fromMs)}`,

  keys: keysText,
  copied: (count) => `已复制${keysText(count)}`,
  held: {
    locked: '所选关键帧所在的行已锁定。',
    beside: '现在只播放和修改别的行，所选关键帧不在其中。',
  },
  nothingBehind: '播放头之后没有内容。',
  nothingToPaste: '请先复制关键帧。',
  noMarker: '还没有标记。',
  nothingToMirror: '左右对调后，这些帧没有变化。',
  notPasted: (problem, nameOf) => `没有粘贴：${pasteProblem(problem, nameOf)}。`,
  swingsTooFar: (name) => `没有缩放：${name}会超出限位。`,
  heldAtLimit: (names) => `${formatNames(names)}会超出限位，停在限位处。`,

  status: {
    nothing: '方向键在关键帧之间移动。回车设关键帧。在空白处拖动来选择。',
    selected: (about, tickMs, turn) =>
      `${about}。可直接输入数值，或用方向键微调${formatWhole(tickMs)}毫秒或${turn}；按住Shift为十倍。Ctrl加方向键移到别的关键帧。`,
    move: '按住Ctrl复制。按住Alt暂停吸附。按住Shift只沿一个方向。Esc放弃，并停止机器人。',
    box: '按住Shift或Ctrl加选。',
    scrub: '按住Alt暂停吸附。按住Shift设循环范围。',
    duration: '按住Alt暂停吸附。联动决定后面的内容是否移动。',
    stretch: '按住Alt暂停吸附。联动会带着后面的内容移动。',
    stretchBack: '按住Alt暂停吸附。最后一个关键帧不动。',
    rested: '抬起打开菜单，拖动来选择。',
    locked: '这一行已锁定。',
    beside: '现在只播放和修改别的行，不含这一行。',
  },
  markerSelected: (about, tickMs) =>
    `${about}。方向键移动${formatWhole(tickMs)}毫秒；按住Shift为十倍。M重命名，Delete删除。`,
  byTouch: {
    nothing: '点按关键帧来选择。长按打开菜单，按住再拖动可多选。双指缩放。',
    selected: (about) => `${about}。拖动，或用箭头微调。长按打开菜单。`,
    marker: (about) => `${about}。拖动来移动。在标记上长按打开菜单。`,
  },
};
