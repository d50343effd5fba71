// Words about driving by pad and keys: names of inputs, what they do, and what the panel says.

import type { Binding, Input, Side } from '#shared/actions/mapping/mapping.ts';
import { formatNames, formatMs, formatPercent, formatWhole, unitSymbol } from '../numbers.ts';
import type { PositionUnit } from '../../numbers.ts';
import { padWords } from '../pad.ts';

/** As most pads print it; the order is the browser's standard one. */
const BUTTONS: readonly string[] = [
  ...['A', 'B', 'X', 'Y', 'Left bumper', 'Right bumper', 'Left trigger', 'Right trigger', 'Back', 'Start'],
  ...['Left stick press', 'Right stick press', 'Pad up', 'Pad down', 'Pad left', 'Pad right', 'Home'],
];

const AXES: readonly Readonly<Record<Side, string>>[] = [
  { whole: 'Left stick sideways', minus: 'Left stick to the left', plus: 'Left stick to the right' },
  { whole: 'Left stick up and down', minus: 'Left stick up', plus: 'Left stick down' },
  { whole: 'Right stick sideways', minus: 'Right stick to the left', plus: 'Right stick to the right' },
  { whole: 'Right stick up and down', minus: 'Right stick up', plus: 'Right stick down' },
];

const SHORT_AXES: readonly string[] = ['Left stick ↔', 'Left stick ↕', 'Right stick ↔', 'Right stick ↕'];

const SIDE_SIGN: Readonly<Record<Side, string>> = { whole: '', minus: ' −', plus: ' +' };

/** `KeyQ` is Q, `Digit1` is 1; others are told as browsers call them. */
const keyName = (code: string): string => code.replace(/^(Key|Digit)/u, '');

function inputName(input: Input): string {
  if (input.kind === 'key') return `Key ${keyName(input.code)}`;
  if (input.kind === 'button') return BUTTONS[input.index] ?? `Button ${formatWhole(input.index)}`;
  return AXES[input.index]?.[input.side] ?? `Axis ${formatWhole(input.index)}${SIDE_SIGN[input.side]}`;
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

export const wholePadWords = {
  ...padWords,
  title: 'Keys and pad',
  drive: 'Drive',
  driveHint: 'While it is off, no key and no stick moves anything. Stop on the pad always works.',
  drivingHint: 'Keys and sticks move the robot. Letting go, or leaving this window, ends it.',
  noPad: 'No pad seen. Press a button on it: the browser shows it only then.',
  otherPad: 'This pad counts its buttons in its own way; the picture may not fit.',
  picture: 'Picture of the pad: what lights up is held',
  allUnknown: (names: readonly string[]): string =>
    `Nobody knows yet where these are: ${formatNames(names)}.`,
  firstMove: 'First move, slowly',
  firstMoveHint: 'Takes the servos that nobody has moved yet to their home, slowly',

  table: 'Which key or stick does what',
  stopRow: 'Stop',
  poseRow: (pose: string): string => `Go to ${pose}`,
  slotRow: (slot: number): string => `Run slot ${formatWhole(slot)}`,
  none: 'Nothing yet',
  edit: (input: string, row: string): string => `${input} for ${row}`,
  input: inputName,
  chip: chipText,

  add: 'Add a key or stick',
  addHint: 'Press or push it, then say what it is to do',
  listening: 'Waiting for a key, a button or a stick. Esc gives up.',
  giveUp: 'Give up',
  form: (input: string): string => `What does ${input} do`,
  does: 'It does',
  actions: {
    rate: 'Turn a servo',
    position: 'Place a servo',
    pose: 'Go to a pose',
    run: 'Run a slot',
    stop: 'Stop',
  },
  servo: 'Servo',
  pose: 'Pose to go to',
  slot: 'Slot to run',
  speedUnit: (unit: PositionUnit): string => `${unitSymbol(unit)}/s`,
  speedField: 'Speed in units a second',
  reversed: 'The other way round',
  save: 'Bind',
  remove: 'Unbind',
  cancel: 'Cancel',
  ready: 'Usual keys and sticks',
  readyHint: 'Replaces every binding by the usual ones. Undo brings yours back.',
  steps: {
    bind: (input: string): string => `bind ${input}`,
    unbind: (input: string): string => `unbind ${input}`,
    feel: 'feel of the sticks',
    ready: 'usual keys and sticks',
  },

  feel: 'Feel',
  speedPercent: 'Speed',
  deadZonePercent: 'Dead zone',
  curvePercent: 'Curve',
  smoothingMs: 'Smoothing',
  percent: (value: number): string => formatPercent(value / 100),
  ms: formatMs,
  plot: 'How far a stick is pushed, and what comes of it',

  conflicts: 'Conflicts',
  sameInput: (input: string, one: string, other: string): string =>
    one === other ? `${input} is bound to ${one} twice.` : `${input} is bound to ${one} and to ${other}.`,
  sharedServo: (name: string): string =>
    `${name} is placed by one input and turned by another; the last one wins.`,
};
