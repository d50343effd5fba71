// The rows of the table of bindings, and the names of inputs: a row per servo of the robot, then the other bindings; and the bindings that
// a robot begins with, of its joints or of the end of a limb. Pure.

import {
  type Binding,
  type Input,
  isOfTip,
  type Mapping,
  readyMapping,
  servoBoundBy,
  type TIP_AXES,
} from '#shared/profile/mapping.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import { servoOf, type Robot } from '#shared/profile/robot.ts';
import { words } from '../../i18n/whole.ts';
import { poseName } from '../poses/poses.ts';
import { servoLabel } from '../../i18n/sentences.ts';

/** As most pads print them, in the order of the browser's standard pad. */
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

/** `KeyQ` is Q, `Digit1` is 1; other keys have the browser's name. */
const keyName = (code: string): string => code.replace(/^(Key|Digit)/u, '');

export function inputName(input: Input): string {
  const { buttons, axes, otherKey, otherButton, otherAxis } = words.pad;
  if (input.kind === 'key') return otherKey({ key: keyName(input.code) });
  if (input.kind === 'tilt') return words.pad.tilts[input.axis][input.side];
  const { index } = input;
  if (input.kind === 'button') {
    const button = BUTTONS[index];
    return button === undefined ? otherButton({ index }) : buttons[button];
  }
  const axis = AXES[index];
  if (axis !== undefined) return axes[axis][input.side];
  return otherAxis({ index }) + { whole: '', minus: ' −', plus: ' +' }[input.side];
}

/** A symbol for a whole axis of a stick or tilt; null for other inputs. */
function shortName(input: Input): string | null {
  if (input.kind === 'tilt' && input.side === 'whole') return words.pad.tilts[input.axis].sign;
  const axis = input.kind === 'axis' && input.side === 'whole' ? AXES[input.index] : undefined;
  return axis === undefined ? null : words.pad.axes[axis].sign;
}

/** Within its row an input needs only its name and direction. */
export function chipText({ input, action }: Binding): string {
  const name = input.kind === 'key' ? keyName(input.code) : (shortName(input) ?? inputName(input));
  if (action.kind !== 'rate' && action.kind !== 'tip') return name;
  const isBothWays = 'side' in input && input.side === 'whole';
  const speed = action.kind === 'rate' ? action.unitsPerS : action.mmPerS;
  return isBothWays ? name : `${name} ${speed < 0 ? '−' : '+'}`;
}

export interface Row {
  readonly id: string;
  readonly title: string;
  /** Indices in the mapping's list. */
  readonly bindings: readonly number[];
}

/** The title of a binding's row. */
export function rowTitle(binding: Binding, robot: Robot, book: PoseBook): string {
  const servo = servoBoundBy(binding);
  if (servo !== null) return servoTitle(robot, servo);
  const { action } = binding;
  if (action.kind === 'tip') return words.pad.tipRows[action.axis];
  if (action.kind === 'pose') return words.pad.poseRow({ pose: poseName(book, action.pose) });
  return action.kind === 'run' ? words.pad.slotRow({ slot: action.slot }) : words.pad.stopRow;
}

export function servoTitle(robot: Robot, servo: number): string {
  const own = servoOf(robot, servo);
  return own === undefined ? words.robots.absent({ servo }) : servoLabel(own);
}

/** Includes servos without a binding. */
export function rowsOf({ bindings }: Mapping, robot: Robot, book: PoseBook): readonly Row[] {
  const ids = bindings.map((binding) => rowId(binding, rowTitle(binding, robot, book)));
  const titles = new Map([
    ...robot.servos.map(({ servo }) => [servoRowId(servo), servoTitle(robot, servo)] as const),
    ...bindings.map((binding, at) => [ids[at] ?? '', rowTitle(binding, robot, book)] as const),
  ]);
  return [...titles].map(([id, title]) => ({
    ...{ id, title },
    bindings: ids
      .flatMap((one, at) => (one === id ? [at] : []))
      .toSorted((one, other) => placeInRow(bindings[one]) - placeInRow(bindings[other])),
  }));
}

const servoRowId = (servo: number): string => `servo ${servo}`;

/** Other bindings with the same title share a row. */
function rowId(binding: Binding, title: string): string {
  const servo = servoBoundBy(binding);
  return servo === null ? title : servoRowId(servo);
}

const ORDER = ['axis', 'tilt', 'button', 'key'] as const;

const placeInRow = (binding: Binding | undefined): number => ORDER.indexOf(binding?.input.kind ?? 'key');

/** The bindings move the end of a limb, or the joints; those of the other choice are stored until it is taken again. */
export function choosingTip(mapping: Mapping, robot: Robot, isOn: boolean): Mapping {
  const { bindings, tip } = mapping;
  if (isOn === isOfTip(mapping)) return mapping;
  return {
    ...mapping,
    bindings: tip?.others ?? readyBindings(robot, isOn),
    tip: { isLevel: false, ...tip, isOn, others: bindings },
  };
}

const READY_MM_PER_S = 80;
const axis = (index: number): Input => ({ kind: 'axis', index, side: 'whole' });
const tilt = (along: 'forward' | 'sideways'): Input => ({ kind: 'tilt', axis: along, side: 'whole' });
const key = (code: string): Input => ({ kind: 'key', code });
/** The keys are those that turn base, shoulder and elbow otherwise. To the right is minus on the axis that goes left. */
const TIP_WAYS: readonly (readonly [Input, (typeof TIP_AXES)[number], sign: 1 | -1])[] = [
  [axis(1), 'x', -1],
  [axis(0), 'y', -1],
  [axis(3), 'z', -1],
  [tilt('forward'), 'x', 1],
  [tilt('sideways'), 'y', -1],
  [key('KeyY'), 'x', 1],
  [key('KeyH'), 'x', -1],
  [key('KeyJ'), 'y', 1],
  [key('KeyU'), 'y', -1],
  [key('KeyR'), 'z', 1],
  [key('KeyF'), 'z', -1],
];

/** For the end of a limb: sticks and keys move it, the first two servos (of an arm, gripper and wrist) turn as before. */
export function readyBindings(robot: Robot, isTip: boolean): readonly Binding[] {
  if (!isTip) return readyMapping(robot).bindings;
  const moving = TIP_WAYS.map(([input, along, sign]): Binding => {
    return { input, action: { kind: 'tip', axis: along, mmPerS: sign * READY_MM_PER_S } };
  });
  return [...readyMapping({ ...robot, servos: robot.servos.slice(0, 2) }).bindings, ...moving];
}
