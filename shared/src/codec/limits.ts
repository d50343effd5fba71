// What a board of a family can take, checked before anything becomes bytes. Knows values and family rows, no bytes.
// A refusal names the field, its value and what is allowed, so that a person can mend it.

import type { Command, Frame, ServoTarget } from './commands.ts';
import { positionRange, type Family, type Range } from './families.ts';

export type RefusedField =
  | 'command'
  | 'durationMs'
  | 'servoCount'
  | 'servo'
  | 'position'
  | 'slot'
  | 'times'
  | 'frameCount'
  | 'frameIndex'
  | 'percent'
  | 'offset'
  | 'length'
  | 'batteryMv'
  | 'version';

interface Refusal {
  readonly field: RefusedField;
  readonly value: number | string;
  readonly range?: Range;
  readonly unit?: string;
  /** Words in place of a range. */
  readonly allowed?: string;
  /** The servo whose value it is. */
  readonly servo?: number;
}

export class RangeRefusal extends RangeError {
  override readonly name = 'RangeRefusal';
  readonly field: RefusedField;
  readonly value: number | string;
  readonly min: number | undefined;
  readonly max: number | undefined;
  readonly allowed: string | undefined;
  readonly servo: number | undefined;

  constructor(refusal: Refusal) {
    super(sentence(refusal));
    this.field = refusal.field;
    this.value = refusal.value;
    this.min = refusal.range?.min;
    this.max = refusal.range?.max;
    this.allowed = refusal.allowed;
    this.servo = refusal.servo;
  }
}

/** For example `position of servo 3 is 2600, allowed 500..2500 µs`. */
function sentence({ field, value, range, unit, allowed, servo }: Refusal): string {
  const subject = servo === undefined ? field : `${field} of servo ${servo}`;
  const span =
    range === undefined ? allowed : `${range.min}..${range.max}${unit === undefined ? '' : ` ${unit}`}`;
  const whole = typeof value === 'number' && !Number.isInteger(value) ? 'whole numbers ' : '';
  return `${subject} is ${value}, allowed ${whole}${span}`;
}

/** Throws RangeRefusal unless `value` is a whole number within `range`. */
export function checkRange(field: RefusedField, value: number, range: Range, unit?: string): void {
  if (Number.isInteger(value) && value >= range.min && value <= range.max) return;
  throw new RangeRefusal({ field, value, range, ...(unit !== undefined && { unit }) });
}

/** Throws RangeRefusal where `family` cannot take `command`. The packet's length is checked where it is known. */
export function checkCommand(command: Command, family: Family): void {
  if (!family.commands.includes(command.kind)) {
    throw new RangeRefusal({ field: 'command', value: command.kind, allowed: family.commands.join(', ') });
  }
  switch (command.kind) {
    case 'move':
      checkFrame(command, { min: 1, max: family.servosPerMove }, family);
      return;
    case 'run':
      checkRange('slot', command.slot, family.slot);
      checkRange('times', command.times, family.runTimes);
      return;
    case 'download':
      checkRange('slot', command.slot, family.slot);
      checkRange('frameCount', command.frameCount, { min: 1, max: family.framesPerGroup });
      checkRange('frameIndex', command.frameIndex, { min: 0, max: command.frameCount - 1 });
      checkFrame(command.frame, { min: 0, max: family.servosPerFrame }, family);
      return;
    case 'setSpeed':
      if (command.slot !== null) checkRange('slot', command.slot, family.slot);
      checkRange('percent', command.percent, family.speedPercent, '%');
      return;
    case 'release':
    case 'readPositions':
      checkServos(command.servos, family);
      return;
    case 'stop':
    case 'erase':
    case 'readBattery':
    case 'readVersion':
    case 'readAllPositions':
    case 'readOffsets':
      return;
  }
}

function checkFrame(frame: Frame, servoCount: Range, family: Family): void {
  checkRange('durationMs', frame.durationMs, family.durationMs, 'ms');
  checkRange('servoCount', frame.targets.length, servoCount);
  const servos = frame.targets.map(({ servo }) => servo);
  frame.targets.forEach((target, index) => {
    checkTarget(target, family);
    checkOnce(servos, index);
  });
}

/** Never all servos at once by an empty list or by 254, only those that are meant. */
function checkServos(servos: readonly number[], family: Family): void {
  checkRange('servoCount', servos.length, { min: 1, max: family.servosPerMove });
  servos.forEach((servo, index) => {
    checkRange('servo', servo, family.servo);
    checkOnce(servos, index);
  });
}

function checkTarget({ servo, position }: ServoTarget, family: Family): void {
  checkRange('servo', servo, family.servo);
  const range = positionRange(family, servo);
  if (Number.isInteger(position) && position >= range.min && position <= range.max) return;
  const unit = family.unit === 'us' ? 'µs' : 'steps';
  throw new RangeRefusal({ field: 'position', value: position, range, unit, servo });
}

/** A servo named twice in one packet: which entry wins is the board's affair, so it is refused. */
function checkOnce(servos: readonly number[], index: number): void {
  const servo = servos[index];
  if (servo !== undefined && servos.indexOf(servo) < index) {
    throw new RangeRefusal({ field: 'servo', value: servo, allowed: 'once in a packet' });
  }
}
