// Words about the page of buttons, its keys and its kiosk.

import type { Colour } from '#shared/actions/colours.ts';
import type { MacroStep } from '#shared/actions/macros/macro.ts';
import { counted, formatMs, formatSeconds, formatWhole } from '../numbers.ts';
import { timesWords } from '../times.ts';
import { macroWords } from '../macros.ts';

const KIOSK_HOLD_S = 2;

export const wholeMacroWords = {
  ...macroWords,
  title: 'Buttons',
  list: 'Buttons',
  noButtons: 'No buttons yet',
  noButtonsHint:
    'A button moves the robot to a pose, plays a slot, or several in turn. Poses also have Make a button. Anybody can use this page.',

  edit: 'Edit buttons',
  add: 'Add button',
  newName: (number: number): string => `Button ${formatWhole(number)}`,
  select: 'Select a button to change it.',
  selected: (name: string): string => `Change ${name}`,
  name: 'Name of the button',
  colour: 'Colour',
  colours: {
    slate: 'Slate',
    indigo: 'Indigo',
    violet: 'Violet',
    plum: 'Plum',
    clay: 'Clay',
    olive: 'Olive',
  } satisfies Record<Colour, string>,
  key: 'Key',
  setKey: 'Set a key',
  pressKey: 'Press a key',
  noKey: 'Remove the key',
  keyUnfit: 'A button takes a letter, a digit or a sign, without Ctrl, Alt or Command.',
  keyTaken: (key: string, from: string): string =>
    `${key.toUpperCase()} was the key of ${from}, which has none now.`,
  keyed: (name: string, key: string | null): string =>
    key === null ? name : `${name}, key ${key.toUpperCase()}`,
  earlier: 'Move button earlier',
  later: 'Move button later',
  delete: 'Delete button',
  moved: (from: number, to: number): string => `Button ${formatWhole(from)} is now button ${formatWhole(to)}`,

  steps: 'Steps',
  addPose: 'Pose',
  addSlot: 'Slot',
  addWait: 'Wait',
  addStep: 'Add a step',
  stepPose: (number: number): string => `Pose of step ${formatWhole(number)}`,
  stepMs: (number: number): string => `Time of step ${formatWhole(number)} in milliseconds`,
  stepSlot: (number: number): string => `Slot of step ${formatWhole(number)}`,
  stepTimes: (number: number): string => `Times of step ${formatWhole(number)}`,
  times: '×',
  stepUp: (number: number): string => `Move step ${formatWhole(number)} up`,
  stepDown: (number: number): string => `Move step ${formatWhole(number)} down`,
  stepDelete: (number: number): string => `Delete step ${formatWhole(number)}`,
  stepAbout: (step: MacroStep, pose: string): string => {
    if (step.kind === 'pose')
      return pose === '' ? formatMs(step.durationMs) : `${pose}, ${formatMs(step.durationMs)}`;
    if (step.kind === 'slot') return `Slot ${formatWhole(step.slot)}, ${timesWords(step.times)}`;
    return `Wait ${formatSeconds(step.waitMs)}`;
  },
  stepCount: (count: number): string => counted(count, 'step'),
  atWork: (step: number, count: number): string =>
    `Step ${formatWhole(step)} of ${formatWhole(count)}. Press to end`,

  kiosk: 'Kiosk',
  kioskHint: `Shows only these buttons and Stop, also after a reload. To leave, hold the button at the lower left for ${formatWhole(KIOSK_HOLD_S)} seconds.`,
  leaveKiosk: `Hold for ${formatWhole(KIOSK_HOLD_S)} seconds to leave`,

  edits: {
    add: (name: string): string => `add ${name}`,
    delete: (name: string): string => `delete ${name}`,
    move: (name: string): string => `move ${name}`,
    rename: (name: string): string => `rename ${name}`,
    colour: (name: string): string => `colour of ${name}`,
    key: (name: string): string => `key of ${name}`,
    steps: (name: string): string => `steps of ${name}`,
  },
};
