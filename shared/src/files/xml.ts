// The vendors' XML (uHand 2.0, LeArm): ID, Move and Time, repeated flat in one table. As tolerant as their own program, which
// counts the three tags wherever they stand, but servo numbers are read and any count of servos is taken (boards.md section 7).

import { type ServoTarget, type Frame, sortedTargets } from '../codec/commands.ts';
import { MAX_FRAMES, type ActionGroup } from '../group/group.ts';
import { type Remark, Unreadable, wholeNumber, type Drawn, type Place, type Unit } from './reading.ts';

// The servos of one frame as a file names them, brought into a group's order.

/** In ascending servo order. Of a servo that is named twice the last position counts, and `remarks` gets it. */
function targetsOf(named: readonly ServoTarget[], frame: number, remarks: Remark[]): readonly ServoTarget[] {
  const targets = sortedTargets(named);
  if (targets.length < named.length) {
    const twice = named.find(({ servo }, index) => named.findIndex((one) => one.servo === servo) < index);
    remarks.push({ code: 'servoTwice', place: { frame }, found: String(twice?.servo) });
  }
  return targets;
}

interface Tag {
  readonly content: string;
  readonly place: Place;
}

const TAG = /<(ID|Move|Time|Type)(?:\s[^<>]*)?>([^<]*)(<\/\1\s*>)?/gi;
const TYPES: readonly (readonly [pattern: RegExp, unit: Unit])[] = [
  [/pwm/i, 'us'],
  [/bus/i, 'steps'],
];

export function readXml(file: string): Drawn {
  const text = withoutComments(file);
  const tags = tagsIn(text);
  const [ids, moves, times] = [tags.id, tags.move, tags.time];
  if (moves.length === 0) throw new Unreadable('noFrames');
  if (moves.length !== times.length || ids.length !== moves.length)
    throw new Unreadable('unpaired', `${ids.length} ID, ${moves.length} Move, ${times.length} Time`);
  if (moves.length > MAX_FRAMES) throw new Unreadable('tooManyFrames', String(moves.length));
  refuseCut(text);
  const remarks: Remark[] = [];
  const frames = moves.map((move, index) => frameOf(move, times[index] ?? move, index + 1, remarks));
  const { unit, remark } = unitOf(tags.type[0]);
  return { unit, frames, remarks: [...remark, ...remarks] };
}

type TagName = 'id' | 'move' | 'time' | 'type';

function tagsIn(text: string): Record<TagName, Tag[]> {
  const tags: Record<TagName, Tag[]> = { id: [], move: [], time: [], type: [] };
  let [line, counted] = [1, 0];
  for (const { 1: name = '', 2: content = '', 3: end, index } of text.matchAll(TAG)) {
    line += linesIn(text.slice(counted, index));
    counted = index;
    if (end === undefined) throw new Unreadable('notClosed', name, { line });
    tags[name.toLowerCase() as TagName].push({ content, place: { line } });
  }
  return tags;
}

function frameOf(move: Tag, time: Tag, number: number, remarks: Remark[]): Frame {
  const durationMs = wholeNumber(time.content.replace(/^\s*T/i, ''), 'badTime', time.place);
  const named = move.content.split('#').map((piece, index) => targetIn(piece, index, move));
  return {
    durationMs,
    targets: targetsOf(
      named.filter((target) => target !== null),
      number,
      remarks,
    ),
  };
}

/** One of the pieces between the number signs; before the first stands nothing. */
function targetIn(piece: string, index: number, { content, place }: Tag): ServoTarget | null {
  if (index === 0 && piece.trim() === '') return null;
  const [, servo, position] = /^\s*(\d+)\s*P\s*(\S+)\s*$/i.exec(index === 0 ? '' : piece) ?? [];
  if (servo === undefined || position === undefined)
    throw new Unreadable('badMove', index === 0 ? content : `#${piece}`, place);
  return {
    servo: wholeNumber(servo, 'badServo', place),
    position: wholeNumber(position, 'badPosition', place),
  };
}

function unitOf(type: Tag | undefined): { unit: Unit | null; remark: readonly Remark[] } {
  if (type === undefined) return { unit: null, remark: [] };
  const [, unit] = TYPES.find(([pattern]) => pattern.test(type.content)) ?? [];
  if (unit !== undefined) return { unit, remark: [] };
  const found = type.content.trim().slice(0, 40);
  return { unit: null, remark: [{ code: 'unknownType', place: type.place, found }] };
}

/** A file may be cut right behind a frame: its root is not closed then. */
function refuseCut(text: string): void {
  const root = /<([A-Za-z_][\w.-]*)/.exec(text)?.[1] ?? '';
  const whole = text.trimEnd();
  const last = whole.slice(Math.max(0, whole.lastIndexOf('</')));
  if (!last.startsWith(`</${root}`) || !last.endsWith('>'))
    throw new Unreadable('cutShort', '', { line: 1 + linesIn(whole) });
}

const linesIn = (text: string): number => text.split('\n').length - 1;

/** Blanks in their place: offsets and lines stay as they were. */
function withoutComments(text: string): string {
  const [before = '', ...pieces] = text.split('<!--');
  const open = pieces.findIndex((piece) => !piece.includes('-->'));
  if (open !== -1) throw new Unreadable('cutShort', '<!--');
  const cleaned = pieces.map((piece) => {
    const end = piece.indexOf('-->') + 3;
    return `    ${piece.slice(0, end).replaceAll(/[^\n]/g, ' ')}${piece.slice(end)}`;
  });
  return [before, ...cleaned].join('');
}

const TYPE_OF: Readonly<Record<Unit, string>> = { us: 'PWM Servo', steps: 'Bus Servo' };

/** With the byte order mark and the declaration that the vendor's program writes itself. */
export function writeXml({ unit, frames }: ActionGroup): string {
  const rows = frames.map(
    ({ durationMs, targets }, index) =>
      `    <ID>${index + 1}</ID>\n    <Move>${targets.map(({ servo, position }) => `#${servo} P${position}`).join(' ')}</Move>\n` +
      `    <Time>T${durationMs}</Time>\n`,
  );
  return (
    '\uFEFF<?xml version="1.0" encoding="utf-8"?>\n<NewDataSet>\n' +
    `  <Type>${TYPE_OF[unit]}</Type>\n  <Table>\n${rows.join('')}  </Table>\n</NewDataSet>\n`
  );
}
