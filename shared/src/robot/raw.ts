// Packets written by hand: whether the board may get one and what it means there, then sent as it is, as the operation that it belongs to.
// Stricter than the board itself: it compares no LEN with what a command needs (S13), so that a known number in another shape acts on
// bytes of earlier packets (S14). Knows no link.

import { isHarmless, type Command, COMMAND_NUMBER, type CommandKind } from '../codec/commands.ts';
import type { RobotEstimate } from './estimate.ts';
import { LinkError } from './linkError.ts';
import { requireQuestion, requireReleased } from './rules.ts';
import type { SessionState } from './state.ts';
import { FIRST_MOVE_MS } from './timings.ts';
import type { Family } from '../codec/families.ts';
import { checkCommand, RangeRefusal } from '../codec/encode.ts';
import { HEADER, MIN_LENGTH } from '../codec/packet.ts';
import { parseCommand } from '../codec/parse.ts';

/** Commands that are more than a packet: each keeps account of what it began. */
export interface RawOperations {
  run(slot: number, times: number): Promise<void>;
  stop(): Promise<void>;
  release(servos: readonly number[]): Promise<void>;
  readBattery(): Promise<unknown>;
  /** Values that wait for these servos do not leave any more: they were requested before. */
  overtake(servos: readonly number[]): void;
  /** Any other packet, as a request. Resolves when it has left. */
  send(packet: Uint8Array): Promise<void>;
}

/** Rejects with a LinkError, or resolves when the packet has left. */
export async function sendRaw(
  bytes: Uint8Array,
  state: SessionState,
  estimate: Pick<RobotEstimate, 'isUnknown' | 'firstMs' | 'hastenedMs' | 'groupMayRun'>,
  operations: RawOperations,
): Promise<void> {
  await send();

  async function send(): Promise<void> {
    const verdict = judgeRaw(bytes, state.family);
    if (verdict.kind === 'refused' || verdict.kind === 'incomplete') {
      const why = verdict.kind === 'refused' ? verdict.reason.code : verdict.kind;
      throw new LinkError('outOfRange', `packet by hand: ${why}`);
    }
    if (verdict.kind === 'command') return perform(verdict.command);
    requireReleased(state);
    return operations.send(bytes);
  }

  async function perform(command: Command): Promise<void> {
    if (command.kind === 'stop') return operations.stop();
    if (isHarmless(command)) requireQuestion(state);
    else requireReleased(state);
    if (command.kind === 'run') return operations.run(command.slot, command.times);
    if (command.kind === 'release') return operations.release(command.servos);
    if (command.kind === 'readBattery') {
      await operations.readBattery();
      return;
    }
    if (command.kind === 'move') {
      requireGentle(command);
      operations.overtake(command.targets.map(({ servo }) => servo));
    }
    return operations.send(bytes);
  }

  /** The bytes are not changed on the way, so what would be slowed down or taken apart elsewhere is refused here. */
  function requireGentle(move: Extract<Command, { kind: 'move' }>): void {
    const unknown = move.targets.map(({ servo }) => servo).filter(estimate.isUnknown);
    if (unknown.length > 1)
      throw new LinkError('outOfRange', `servos ${unknown.join(', ')} make their first moves one by one`);
    if (estimate.groupMayRun()) throw new LinkError('busy', 'a group may run: end it first');
    const needsMs = estimate.firstMs(move.targets.map(({ servo }) => servo));
    if (needsMs > move.durationMs) {
      const reason = `the first move of a servo takes ${FIRST_MOVE_MS} ms, this one at least ${needsMs}`;
      throw new LinkError('outOfRange', reason);
    }
    const hastenedMs = estimate.hastenedMs(move);
    if (hastenedMs === 0) return;
    const reason = `another servo is under way for ${hastenedMs} ms more and would get there as fast as this move`;
    throw new LinkError('outOfRange', reason);
  }
}

export type RawVerdict =
  | { readonly kind: 'command'; readonly command: Command }
  /** The board has no such command and does nothing. */
  | { readonly kind: 'ignored'; readonly number: number }
  /** `missing` bytes; null before LEN says how many. */
  | { readonly kind: 'incomplete'; readonly missing: number | null }
  | { readonly kind: 'refused'; readonly reason: RawRefusal };

export type RawRefusal =
  | { readonly code: 'noHeader' }
  | { readonly code: 'shortLength' | 'longLength'; readonly length: number; readonly limit: number }
  | { readonly code: 'tooLong'; readonly extra: number }
  | { readonly code: 'neverSend' | 'unknownNumber'; readonly number: number }
  /** Written to flash, which needs the waiting and the marks of the operation itself. */
  | { readonly code: 'flash' }
  | { readonly code: 'otherShape'; readonly command: CommandKind }
  | { readonly code: 'limits'; readonly refusal: RangeRefusal };

const KINDS = new Map(Object.entries(COMMAND_NUMBER).map(([kind, number]) => [number, kind as CommandKind]));
const FLASH: readonly CommandKind[] = ['erase', 'download'];
/** Two headers and LEN, which it does not count itself. */
const UNCOUNTED = 2;

/** Judges as much as is there, so that a packet can be judged while it is being typed. */
export function judgeRaw(bytes: Uint8Array, family: Family): RawVerdict {
  const reason = headRefusal(bytes, family);
  if (reason !== null) return { kind: 'refused', reason };
  const [, , length, number] = bytes;
  if (length === undefined) return { kind: 'incomplete', missing: null };
  const missing = length + UNCOUNTED - bytes.length;
  if (missing > 0) return { kind: 'incomplete', missing };
  if (missing < 0) return { kind: 'refused', reason: { code: 'tooLong', extra: -missing } };
  return judgeWhole(number ?? 0, bytes.subarray(4), family);
}

function headRefusal(bytes: Uint8Array, family: Family): RawRefusal | null {
  const [first = HEADER, second = HEADER, length = MIN_LENGTH, number] = bytes;
  if (first !== HEADER || second !== HEADER) return { code: 'noHeader' };
  if (length < MIN_LENGTH) return { code: 'shortLength', length, limit: MIN_LENGTH };
  if (length > family.maxLength) return { code: 'longLength', length, limit: family.maxLength };
  return number === undefined ? null : numberRefusal(number, family);
}

function numberRefusal(number: number, family: Family): RawRefusal | null {
  if (family.neverSend.includes(number)) return { code: 'neverSend', number };
  const kind = kindFor(number, family);
  if (kind === null) return family.ignoresUnknown ? null : { code: 'unknownNumber', number };
  return FLASH.includes(kind) ? { code: 'flash' } : null;
}

function judgeWhole(number: number, params: Uint8Array, family: Family): RawVerdict {
  const kind = kindFor(number, family);
  if (kind === null) return { kind: 'ignored', number };
  const command = parseCommand({ command: number, params });
  if (command === null) return { kind: 'refused', reason: { code: 'otherShape', command: kind } };
  try {
    checkCommand(command, family);
    return { kind: 'command', command };
  } catch (error) {
    if (!(error instanceof RangeRefusal)) throw error;
    return { kind: 'refused', reason: { code: 'limits', refusal: error } };
  }
}

/** Null where this family has no such command, whatever others make of the number. */
function kindFor(number: number, family: Family): CommandKind | null {
  const kind = KINDS.get(number);
  return kind !== undefined && family.commands.includes(kind) ? kind : null;
}
