// What the gateway says in its own words, as the session has it, and the other way round. Pure: knows no socket.

import type { MotionBefore } from '#shared/motion/before.ts';
import { isHarmless } from '#shared/protocol/commands.ts';
import { FAMILIES, type BoardId } from '#shared/protocol/families.ts';
import { toHex } from '#shared/protocol/hex.ts';
import { commandIn } from '#shared/protocol/parse.ts';
import { LinkError } from '#shared/session/linkError.ts';
import type { SharedLatchReason } from '#shared/session/transport.ts';
import { refusal } from './gatewayHttp.ts';
import type { MotionTold, PortState, StateMessage } from './messages.generated.ts';

export const LATCHED_BY: Readonly<Record<NonNullable<StateMessage['latchedBy']>, SharedLatchReason>> = {
  person: 'elsewhere',
  battery: 'battery',
  silence: 'unwatched',
  loss: 'reconnected',
};

/** A newer gateway may know boards that this page does not. */
export function boardNamed(text: string): BoardId {
  return text in FAMILIES ? (text as BoardId) : 'unknown';
}

/** Needs nobody's leave. */
export function isQuestion(packet: Uint8Array): boolean {
  const command = commandIn(packet);
  return command !== null && isHarmless(command);
}

export function motionBefore({ servos, runSlot, released }: MotionTold): MotionBefore {
  const ways = servos.map(({ start, target, ...way }) => ({ ...way, from: start, to: target }));
  return { ways, runSlot, released };
}

export function portError(port: PortState | null): LinkError {
  if (port === null) return new LinkError('gatewayUnreachable', 'the gateway does not answer');
  return refusal(port.code ?? 'closed', port.detail ?? 'the port of the gateway is closed');
}

/** The gateway's spelling of bytes: lower case, no spaces. */
export function compactHex(bytes: Uint8Array): string {
  return toHex(bytes).replaceAll(' ', '').toLowerCase();
}
