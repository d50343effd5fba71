// What inputs are called: keys, buttons and sticks, as most pads print them; the order is the browser's standard one.

import type { Binding, Input } from '#shared/profile/mapping.ts';
import { words } from '../../i18n/whole.ts';

const BUTTONS = [
  ...([
    'a',
    'b',
    'x',
    'y',
    'leftBumper',
    'rightBumper',
    'leftTrigger',
    'rightTrigger',
    'back',
    'start',
  ] as const),
  ...(['leftStick', 'rightStick', 'up', 'down', 'left', 'right', 'home'] as const),
];

const AXES = ['leftX', 'leftY', 'rightX', 'rightY'] as const;

/** `KeyQ` is Q, `Digit1` is 1; others as browsers call them. */
const keyName = (code: string): string => code.replace(/^(Key|Digit)/u, '');

export function inputName(input: Input): string {
  const { buttons, axes, otherKey, otherButton, otherAxis } = words.pad;
  if (input.kind === 'key') return otherKey({ key: keyName(input.code) });
  const { index } = input;
  if (input.kind === 'button') {
    const button = BUTTONS[index];
    return button === undefined ? otherButton({ index }) : buttons[button];
  }
  const axis = AXES[index];
  if (axis !== undefined) return axes[axis][input.side];
  return otherAxis({ index }) + { whole: '', minus: ' −', plus: ' +' }[input.side];
}

/** A whole stick's way as a sign; null for anything else. */
function shortName(input: Input): string | null {
  const axis = input.kind === 'axis' && input.side === 'whole' ? AXES[input.index] : undefined;
  return axis === undefined ? null : words.pad.axes[axis].sign;
}

/** In its row an input needs its name and direction only. */
export function chipText({ input, action }: Binding): string {
  const name = input.kind === 'key' ? keyName(input.code) : (shortName(input) ?? inputName(input));
  if (action.kind !== 'rate') return name;
  const isBothWays = input.kind === 'axis' && input.side === 'whole';
  return isBothWays ? name : `${name} ${action.unitsPerS < 0 ? '−' : '+'}`;
}
