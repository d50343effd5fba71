// What links share of the gateway: its HTTP interface, of which every failure is a LinkError, and the values of its messages as the snapshot has
// them, and the other way round. Knows no route and no socket.

import type { MotionBefore } from '#shared/motion/model.ts';
import { isHarmless, type Command, type Frame } from '#shared/codec/commands.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import { FAMILIES, type BoardId, type Family } from '#shared/codec/families.ts';
import { fromHex, toHex } from '#shared/codec/packet.ts';
import { commandIn } from '#shared/codec/parse.ts';
import type { Report } from '#shared/codec/reports.ts';
import type { Identity } from '#shared/robot/identity.ts';
import { isLinkErrorCode, LinkError } from '#shared/robot/linkError.ts';
import type { LatchReason } from '#shared/robot/state.ts';
import { GatewayProblem, type Path, type Verb } from '#shared/client/request.ts';
import { request, type RequestOptions } from '../request.ts';
import type {
  FrameBody,
  MotionState,
  PortState,
  ReceivedMessage,
  StateMessage,
} from '#shared/client/messages.generated.ts';

/** Behind two headers, LEN and CMD. */
const PARAMS_AT = 4;

export const LATCHED_BY: Readonly<Record<NonNullable<StateMessage['latchedBy']>, LatchReason>> = {
  person: 'elsewhere',
  battery: 'battery',
  silence: 'unwatched',
  loss: 'reconnected',
};

/** What the gateway says of the board on its port; `board` is what it is driven as. */
export type BoardAtGateway = { readonly board: BoardId; readonly identity: Identity } & (
  | { readonly status: 'identifying' | 'ready' | 'stale'; readonly error: null }
  | { readonly status: 'refused'; readonly error: LinkError }
);

/** null while nothing is known of one: its port is not open. */
export function boardOf({ board, link, identity }: Omit<StateMessage, 'type'>): BoardAtGateway | null {
  const { status, code, detail } = link;
  if (status === 'closed' || status === 'opening' || status === 'lost') return null;
  // A newer gateway may know boards that this page does not.
  const known = {
    board: board in FAMILIES ? (board as BoardId) : 'unknown',
    identity: identity as Identity,
  } as const;
  if (status === 'refused') return { ...known, status, error: refusal(code ?? 'internal', detail ?? '') };
  return known.board === 'unknown' && status !== 'identifying'
    ? { ...known, status: 'refused', error: refusal('boardUnknown', '') }
    : { ...known, status, error: null };
}

/** Needs no lease. */
export function isHarmlessPacket(packet: Uint8Array): boolean {
  const command = commandIn(packet);
  return command !== null && isHarmless(command);
}

export function motionBefore(
  { servos, runSlot, released, reported }: MotionState,
  nowMs: number,
): MotionBefore {
  const ways = servos.map(({ start, target, ...way }) => ({ ...way, from: start, to: target }));
  const said = reported.map(({ ageMs, ...one }) => ({ ...one, atMs: nowMs - ageMs }));
  return { ways, runSlot, released, reported: said };
}

export function frameBody({ durationMs, targets }: Frame): FrameBody {
  return {
    durationMs,
    positions: Object.fromEntries(targets.map(({ servo, position }) => [servo, position])),
  };
}

export function portError(port: PortState | null): LinkError {
  if (port === null) return new LinkError('gatewayUnreachable', 'the gateway does not answer');
  return refusal(port.code ?? 'closed', port.detail ?? 'the port of the gateway is closed', port.heldBy);
}

/** The gateway's spelling of bytes: lower case, no spaces. */
export function compactHex(bytes: Uint8Array): string {
  return toHex(bytes).replaceAll(' ', '').toLowerCase();
}

export function reportIn({ report, bytes }: ReceivedMessage): Report {
  return report.kind === 'unknown' ? { ...report, params: fromHex(bytes).slice(PARAMS_AT) } : report;
}

/** A board that is being identified gets queries that only others know. */
export function bytesForLog(command: Command, family: Family): Uint8Array | null {
  for (const one of [family, ...Object.values(FAMILIES)]) {
    try {
      return encodeCommand(command, one);
    } catch {
      continue;
    }
  }
  return null;
}

/** Rejects where no answer comes in time, and with the gateway's reason where it refuses. */
export async function askGateway<P extends Path, V extends Verb<P>>(
  verb: V,
  path: P,
  requested: RequestOptions<P, V>,
): Promise<unknown> {
  try {
    return await request(verb, path, requested);
  } catch (error) {
    if (!(error instanceof GatewayProblem)) throw error;
    const { code, message, heldBy } = error;
    throw code === null
      ? new LinkError('gatewayUnreachable', message, { cause: error })
      : refusal(code, message, heldBy);
  }
}

export function refusal(code: string, detail: string, heldBy: readonly string[] = []): LinkError {
  return new LinkError(isLinkErrorCode(code) ? code : 'gatewayRefused', detail, { heldBy });
}
