// Packets written by hand: sent as they are, as the operation that each belongs to, or refused. Knows which of them need what; what a
// packet says and whether the family may get it is rawPacket.ts.

import { isHarmless, type Command } from '../codec/commands.ts';
import { judgeRaw } from '../codec/rawPacket.ts';
import type { RobotEstimate } from './estimate.ts';
import { LinkError } from './linkError.ts';
import { requireQuestion, requireReleased } from './rules.ts';
import type { SessionState } from './state.ts';
import { FIRST_MOVE_MS } from './timings.ts';

/** Commands that are more than a packet: each keeps account of what it began. */
export interface RawOperations {
  run(slot: number, times: number): Promise<void>;
  stop(): Promise<void>;
  release(servos: readonly number[]): Promise<void>;
  readBattery(): Promise<unknown>;
  /** Values that wait for these servos do not leave any more: they were asked for before. */
  overtake(servos: readonly number[]): void;
  /** Any other packet, as a request. Resolves when it has left. */
  send(packet: Uint8Array): Promise<void>;
}

/** Rejects with a LinkError, or resolves when the packet has left. */
export async function sendRaw(
  bytes: Uint8Array,
  state: SessionState,
  estimate: Pick<RobotEstimate, 'isUnknown' | 'firstMs'>,
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
    const needsMs = estimate.firstMs(move);
    if (needsMs <= move.durationMs) return;
    const reason = `the first move of a servo takes ${FIRST_MOVE_MS} ms, this one at least ${needsMs}`;
    throw new LinkError('outOfRange', reason);
  }
}
