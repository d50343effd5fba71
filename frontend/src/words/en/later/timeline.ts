// Words of the timeline: its verbs and steps, what is asked for in place, and what each key and row is called for ears.

import type { Colour } from '#shared/actions/colours.ts';
import type { PasteProblem } from '#shared/actions/group/clip.ts';
import type { Easing } from '#shared/actions/group/group.ts';
import { markText, secondsText } from '../../instants.ts';
import {
  counted,
  formatCount,
  formatNames,
  formatMs,
  formatPercent,
  formatWhole,
  unitSymbol,
} from '../numbers.ts';

const keysText = (count: number): string => counted(count, 'key');

const formatInstant = (atMs: number): string => `${secondsText(atMs)} s`;

const signedInstant = (byMs: number): string => `${byMs < 0 ? '−' : '+'}${formatInstant(Math.abs(byMs))}`;

const easings: Readonly<Record<Easing, string>> = {
  linear: 'linear',
  in: 'ease in',
  out: 'ease out',
  inOut: 'ease in and out',
  hold: 'hold',
};

const colours: Readonly<Record<Colour, string>> = {
  slate: 'Slate',
  indigo: 'Indigo',
  violet: 'Violet',
  plum: 'Plum',
  clay: 'Clay',
  olive: 'Olive',
};

/** Verbs that mean another thing while a marker is selected. */
const markerVerbs: Readonly<Partial<Record<string, string>>> = {
  marker: 'Rename marker',
  remove: 'Delete marker',
};

const pasteProblem = (problem: PasteProblem, nameOf: (servo: number) => string): string => {
  switch (problem.kind) {
    case 'unit':
      return `its positions are in ${unitSymbol(problem.clip)}, this group counts in ${unitSymbol(problem.group)}`;
    case 'tooManyFrames':
      return `${formatCount(problem.count)} frames are more than the ${formatCount(problem.limit)} a group holds`;
    case 'position':
      return `${nameOf(problem.servo)} at ${formatWhole(problem.position)} is out of range; it takes ${formatWhole(problem.min)} to ${formatWhole(problem.max)}`;
  }
};

export const timelineWords = {
  title: 'Timeline',
  grid: 'Timeline: servos down, time across',
  toolbar: 'Change the timeline',
  menu: 'What to do here',
  rowAll: 'All servos',
  noName: (servo: number): string => `Servo ${formatWhole(servo)}`,
  mark: markText,
  instant: formatInstant,
  playhead: 'Playhead',
  seen: (from: number, to: number): string => `${formatPercent(from)} to ${formatPercent(to)}`,
  minimap: 'The whole group; drag to look elsewhere',
  easings,
  easing: 'Easing',
  colours,
  colour: 'Colour',
  noColour: 'No colour',

  /** What a key says of itself. */
  key: (row: string, atMs: number, position: string, easing: Easing): string =>
    `${row}, ${formatInstant(atMs)}, ${position}, ${easings[easing]}`,
  summary: (row: string, frame: number, atMs: number, count: number): string =>
    `${row}, frame ${formatWhole(frame)}, ${formatInstant(atMs)}, ${keysText(count)}`,
  noKey: (row: string): string => `${row}, no key`,

  verbs: {
    setKey: 'Set key',
    editValue: 'Edit value',
    remove: 'Delete keys',
    removeTime: 'Delete with its time',
    cut: 'Cut',
    copy: 'Copy',
    paste: 'Paste',
    duplicate: 'Duplicate keys',
    insertTime: 'Insert time',
    reverse: 'Reverse',
    mirror: 'Mirror left and right',
    scaleTime: 'Scale time',
    scaleTimeBack: 'Scale time from the end',
    scaleAmplitude: 'Scale amplitude',
    note: 'Note on frame',
    marker: 'Set marker',
    selectAll: 'Select all keys',
    selectRow: 'Select the row',
    selectNone: 'Select nothing',
    zoomIn: 'Zoom in',
    zoomOut: 'Zoom out',
    fitAll: 'Fit all',
    fitSelection: 'Fit selection',
    range: 'Loop selection',
    frameBefore: 'Frame before',
    frameAfter: 'Frame after',
    keyBefore: 'Key before',
    keyAfter: 'Key after',
    nextMarker: 'Next marker',
  },
  markerVerbs,
  nudge: 'By a little',
  nudges: {
    earlier: (by: string): string => `Earlier by ${by}`,
    later: (by: string): string => `Later by ${by}`,
    lower: (by: string): string => `Lower by ${by}`,
    higher: (by: string): string => `Higher by ${by}`,
  },
  more: 'More',
  change: 'Change',
  look: 'Select and look',
  switches: { snaps: 'Snap', ripples: 'Ripple', showsPreview: 'Outline', isTall: 'Tall rows' },
  snapsHint: 'To frames, keys, markers, playhead and the board’s raster; hold Alt to suspend',
  ripplesHint: 'What is behind a change moves along',
  previewHint: 'Shows the pose at the playhead on the body. Moves nothing.',
  tallHint: 'Room to turn values by hand',

  rows: {
    fold: (limb: string, count: number): string => `Rows of ${limb}, ${counted(count, 'servo')}`,
    select: (row: string): string => `Select the keys of ${row}`,
    tools: (row: string): string => `Row of ${row}`,
    menu: 'Row',
    value: 'Of the group at the playhead; the robot may be elsewhere',
    lock: 'Lock',
    unlock: 'Unlock',
    mute: 'Mute',
    unmute: 'Unmute',
    solo: 'Play and change only this',
    unsolo: 'Play and change all again',
    arm: 'Arm for recording',
    disarm: 'Record no more',
    hide: 'Hide',
    foldAway: 'Fold away',
    unfold: 'Unfold',
    showHidden: (count: number): string => `Show hidden rows: ${formatCount(count)}`,
    locked: 'locked',
    muted: 'muted',
    armed: 'armed for recording',
  },

  changes: '+10, −=10, *1.2 or /2 changes each of them',
  asks: {
    value: 'Position of the selected keys',
    scaleTime: 'New length of the stretch in percent',
    scaleTimeBack: 'New length of the stretch in percent, its end stays',
    scaleAmplitude: 'New amplitude about the mean in percent',
    insertTime: 'Time to insert at the playhead in milliseconds',
    note: 'Note on the frame',
    marker: 'Text of the marker',
  },
  percent: '%',
  newMarker: (number: number): string => `Marker ${formatWhole(number)}`,

  steps: {
    setKey: 'set key',
    move: 'move keys',
    value: 'position of keys',
    delete: (count: number): string => `delete ${keysText(count)}`,
    deleteTime: 'delete time',
    paste: 'paste keys',
    cut: (count: number): string => `cut ${keysText(count)}`,
    duplicate: 'duplicate keys',
    reverse: 'reverse',
    mirror: 'mirror',
    ease: (easing: string): string => easing,
    colour: 'colour of frames',
    note: 'note',
    duration: (frame: number): string => `time of frame ${formatWhole(frame)}`,
    stretch: 'stretch',
    scaleTime: 'scale time',
    scaleAmplitude: 'scale amplitude',
    insertTime: 'insert time',
    addMarker: 'set marker',
    moveMarker: 'move marker',
    renameMarker: 'marker',
    deleteMarker: 'delete marker',
  },

  /** `count`: with those that come along. */
  draggedKey: (key: string, byMs: number, count: number): string =>
    [key, byMs === 0 ? '' : signedInstant(byMs), count < 2 ? '' : keysText(count)]
      .filter((part) => part !== '')
      .join('; '),
  draggedEnd: (frame: number, durationMs: number, atMs: number): string =>
    `Frame ${formatWhole(frame)}: ${formatMs(durationMs)}, until ${formatInstant(atMs)}`,
  draggedStretch: (share: number, lengthMs: number): string =>
    `${formatPercent(share)}, ${formatInstant(Math.round(lengthMs))}`,
  draggedMarker: (text: string, atMs: number): string => `${text}, ${formatInstant(atMs)}`,
  draggedRange: (fromMs: number, toMs: number): string =>
    `${formatInstant(fromMs)} to ${formatInstant(toMs)}, ${formatInstant(toMs - fromMs)} long`,

  keys: keysText,
  copied: (count: number): string => `${keysText(count)} copied`,
  held: {
    locked: 'The selected keys are on locked rows.',
    beside: 'The selected keys are beside the row that alone plays and changes.',
  },
  nothingBehind: 'Nothing stands behind the playhead.',
  nothingToPaste: 'Copy some keys first.',
  noMarker: 'There is no marker yet.',
  nothingToMirror: 'These frames are the same when left and right change places.',
  notPasted: (problem: PasteProblem, nameOf: (servo: number) => string): string =>
    `Not pasted: ${pasteProblem(problem, nameOf)}.`,
  swingsTooFar: (name: string): string => `Not scaled: ${name} would go beyond its limits.`,
  heldAtLimit: (names: readonly string[]): string =>
    names.length === 1
      ? `${formatNames(names)} would go beyond its limit and stands at it.`
      : `${formatNames(names)} would go beyond their limits and stand at them.`,

  /** What keys and pointer do right now. */
  status: {
    nothing: 'Arrows go from key to key. Enter sets a key. Drag over an empty place to select.',
    /** `about`: the key, or how many they are; `turn`: how far an arrow turns them. */
    selected: (about: string, tickMs: number, turn: string): string =>
      `${about}. Type a number, or nudge with arrows by ${formatWhole(tickMs)} ms or ${turn}; Shift: ten times. Ctrl and arrows go to a key.`,
    move: 'Ctrl copies. Alt suspends snapping. Shift keeps to one direction. Esc calls off, and stops the robot.',
    box: 'Shift or Ctrl adds to the selection.',
    scrub: 'Alt suspends snapping. Shift sets the loop range.',
    duration: 'Alt suspends snapping. Ripple decides about what is behind.',
    stretch: 'Alt suspends snapping. Ripple carries what is behind along.',
    stretchBack: 'Alt suspends snapping. The last key stays.',
    rested: 'Lift for the menu, or drag to select.',
    locked: 'This row is locked.',
    beside: 'This row is beside the one that alone plays and changes.',
  },
  /** `about`: the marker. */
  markerSelected: (about: string, tickMs: number): string =>
    `${about}. Arrows move it by ${formatWhole(tickMs)} ms; Shift: ten times. M renames it, Delete takes it away.`,
  byTouch: {
    nothing:
      'Touch a key to select it. Rest a finger for more, or drag on to select several. Two fingers zoom.',
    selected: (about: string): string => `${about}. Drag, or nudge with the arrows. Rest a finger for more.`,
    marker: (about: string): string => `${about}. Drag to move it. Rest a finger on it for more.`,
  },
};
