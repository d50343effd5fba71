// Values to packets. A command leaves here only if the board's family can take it; a refusal names the field, its value and what is
// allowed. Knows no time and no link. Byte layouts: protocol document (boards.md chapter 1).

import { ALL_GROUPS, COMMAND_NUMBER, type Command, type Frame, type ServoTarget } from './commands.ts';
import { type Family, positionRange, type Range } from './families.ts';
import { HEADER, MIN_LENGTH, packetBytes } from './packet.ts';
import { SERVO_TYPES, type Report, type ServoOffset } from './reports.ts';

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

/** Never all servos at once by an empty list or by 254, only those that are listed. */
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

const BYTE = { min: 0, max: 0xff };
const WORD = { min: 0, max: 0xffff };
const SIGNED_BYTE = { min: -0x80, max: 0x7f };
const SIGNED_WORD = { min: -0x8000, max: 0x7fff };
/** Bytes before the parameters: two headers, LEN, CMD. */
const PREFIX = 4;

/** The whole packet. Throws RangeRefusal where a board of this family cannot take the command. */
export function encodeCommand(command: Command, family: Family): Uint8Array {
  checkCommand(command, family);
  const params = paramCount(command, family);
  checkRange('length', params + MIN_LENGTH, { min: MIN_LENGTH, max: family.maxLength });
  const packet = emptyPacket(COMMAND_NUMBER[command.kind], params);
  switch (command.kind) {
    case 'move':
      writeFrame(packet, PREFIX, command);
      break;
    case 'run':
      packet[4] = command.slot;
      writeWord(packet, 5, command.times);
      break;
    case 'download':
      packet[4] = command.slot;
      packet[5] = command.frameCount;
      packet[6] = command.frameIndex;
      writeFrame(packet, 7, command.frame);
      break;
    case 'setSpeed':
      packet[4] = command.slot ?? ALL_GROUPS;
      writeWord(packet, 5, command.percent);
      break;
    case 'release':
    case 'readPositions':
      packet.set([command.servos.length, ...command.servos], PREFIX);
      break;
    case 'stop':
    case 'erase': // its one byte is reserved and stays 0
    case 'readBattery':
    case 'readVersion':
    case 'readAllPositions':
    case 'readOffsets':
      break;
  }
  return packet;
}

function paramCount(command: Command, family: Family): number {
  switch (command.kind) {
    case 'move':
      return 3 + 3 * command.targets.length;
    case 'run':
    case 'setSpeed':
      return 3;
    case 'release':
    case 'readPositions':
      return 1 + command.servos.length;
    case 'download':
      return 6 + 3 * command.frame.targets.length;
    case 'erase':
      return family.eraseLength - MIN_LENGTH;
    case 'stop':
    case 'readBattery':
    case 'readVersion':
    case 'readAllPositions':
    case 'readOffsets':
      return 0;
  }
}

function emptyPacket(command: number, params: number): Uint8Array {
  const packet = new Uint8Array(PREFIX + params);
  packet[0] = HEADER;
  packet[1] = HEADER;
  packet[2] = params + MIN_LENGTH;
  packet[3] = command;
  return packet;
}

/** Count, time, then servo and position of each target: the tail that moves and stored frames share. */
function writeFrame(packet: Uint8Array, at: number, { durationMs, targets }: Frame): void {
  packet[at] = targets.length;
  writeWord(packet, at + 1, durationMs);
  let entry = at + 3;
  for (const { servo, position } of targets) {
    packet[entry] = servo;
    writeWord(packet, entry + 1, position);
    entry += 3;
  }
}

function writeWord(packet: Uint8Array, at: number, value: number): void {
  packet[at] = value & 0xff;
  packet[at + 1] = value >> 8;
}

/**
 * What a board would send, for boards in software. Throws RangeRefusal where a value does not fit its field. A finished
 * run that names its slot says `once`: the report's value keeps no number of times.
 */
export function encodeReport(report: Report): Uint8Array {
  switch (report.kind) {
    case 'runAccepted':
      return packetBytes(6, []);
    case 'runStarted':
      return runReport(6, report.slot, report.times);
    case 'runFinished':
      return report.slot === null ? packetBytes(7, []) : runReport(8, report.slot, 1);
    case 'runStopped':
      return packetBytes(7, []);
    case 'erased':
      return packetBytes(8, []);
    case 'battery':
      checkRange('batteryMv', report.batteryMv, WORD, 'mV');
      return packetBytes(15, [report.batteryMv & 0xff, report.batteryMv >> 8]);
    case 'frameStored':
      return packetBytes(25, []);
    case 'positions':
      return packetBytes(21, [report.positions.length, ...report.positions.flatMap(positionBytes)]);
    case 'allPositions':
      return packetBytes(13, report.positions.flatMap(positionBytes));
    case 'offsets':
      return packetBytes(2, report.offsets.flatMap(offsetBytes));
    case 'version':
      checkRange('version', report.version, BYTE);
      return packetBytes(1, [SERVO_TYPES.indexOf(report.unit), report.version]);
    case 'unknown':
      return packetBytes(report.command, report.params);
  }
}

function positionBytes({ servo, position }: ServoTarget): number[] {
  checkRange('servo', servo, BYTE);
  checkRange('position', position, SIGNED_WORD);
  return [servo, position & 0xff, (position >> 8) & 0xff];
}

function offsetBytes({ servo, offset }: ServoOffset): number[] {
  checkRange('servo', servo, BYTE);
  checkRange('offset', offset, SIGNED_BYTE);
  return [servo, offset & 0xff];
}

function runReport(command: number, slot: number, times: number): Uint8Array {
  checkRange('slot', slot, BYTE);
  checkRange('times', times, WORD);
  return packetBytes(command, [slot, times & 0xff, times >> 8]);
}
