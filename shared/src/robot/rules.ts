// What may begin now, judged by the snapshot, and what a board of the family does not take. Every refusal is a LinkError. Knows no
// link: a robot on its own channel and a robot at the gateway refuse by the same rules.

import type { Command, FrameCommand } from '../codec/commands.ts';
import { encodeCommand, RangeRefusal, checkCommand } from '../codec/encode.ts';
import type { Family } from '../codec/families.ts';
import { isWatching, notDriving } from './lease.ts';
import { LinkError } from './linkError.ts';
import type { LinkState, SessionState, SlotGroup, Withheld } from './state.ts';

/** What is known of the robot besides the snapshot. */
export interface RestQuestions {
  /** Something is on its way, as far as can be known. */
  isMoving(): boolean;
  /** A move or a stop of ours is still to leave. */
  isUnsettled(): boolean;
}

/** Like `encodeCommand`, with the refusal as a LinkError the page has words for. */
export const encodeOrRefuse = (command: Command, family: Family): Uint8Array =>
  orRefuse(encodeCommand, command, family);

/** The same refusal, of what is encoded later. */
export const refuseUnfit = (command: Command, family: Family): void =>
  orRefuse(checkCommand, command, family);

function orRefuse<T>(work: (command: Command, family: Family) => T, command: Command, family: Family): T {
  if (!family.commands.includes(command.kind)) {
    throw new LinkError('notSupported', `${family.name} has no command "${command.kind}"`);
  }
  try {
    return work(command, family);
  } catch (error) {
    if (error instanceof RangeRefusal) throw new LinkError('outOfRange', error.message, { cause: error });
    throw error;
  }
}

/** Whether the board knows it is another question. */
export function requireCarried({ withheld }: SessionState, kind: Withheld): void {
  if (withheld.includes(kind)) throw new LinkError('notOnThisCable', `this link does not carry "${kind}"`);
}

/** The link is there and the board is not deaf with flash work (S41). */
export function requireReady({ link, activity }: SessionState): void {
  if (link.status !== 'ready') throw notReady(link);
  if (activity.kind === 'downloading' || activity.kind === 'erasing') {
    throw new LinkError('busy', `${activity.kind}: wait for its end or cancel it`);
  }
}

/** The line is there, and so was the board: questions may go out, also to hear whether it is still there. */
export function requireLine(state: SessionState): void {
  if (state.link.status !== 'stale') requireReady(state);
}

/** Additionally a question does no harm: on some boards any of them ends a running group, unsaid (L8). */
export function requireQuestion(state: SessionState): void {
  requireReady(state);
  if (state.family.queryKillsRun && state.activity.kind === 'running')
    throw new LinkError('busy', 'asking would end the running group: end it first');
}

/** The board is ready, motion is not latched, and no other client drives. */
export function requireReleased(state: SessionState): void {
  requireReady(state);
  if (state.latch !== null) throw new LinkError('latched', 'stopped: resume first');
  if (isWatching(state.lease)) throw notDriving(state.lease);
}

/**
 * Additionally the robot is at rest and stays so: flash work freezes the servos and then lets them jump (S29, S39), and a
 * packet that comes meanwhile overwrites what is being stored (S11).
 */
export function requireRest(state: SessionState, { isMoving, isUnsettled }: RestQuestions): void {
  requireReleased(state);
  if (state.mayBeRunning)
    throw new LinkError(
      'busy',
      'what ran before the link was opened may go on for 30 s: try again when it is over',
    );
  if (state.activity.kind !== 'idle' || isMoving() || isUnsettled())
    throw new LinkError('busy', 'the robot is moving: wait or stop it first');
}

/** The group in `slot` is whole and the page plays nothing. */
export function requireRunnable(state: SessionState, slot: number, times: number): void {
  requireReleased(state);
  refuseUnfit({ kind: 'run', slot, times }, state.family);
  if (state.brokenSlots.includes(slot))
    throw new LinkError('slotBroken', `slot ${slot} holds half a group: download it again`);
  if (state.activity.kind === 'playing') throw new LinkError('busy', 'the page is playing: stop it first');
}

/** Checks again after the identification: nothing may be under way. */
export function requireIdle({ activity }: SessionState, { isMoving }: Pick<RestQuestions, 'isMoving'>): void {
  if (activity.kind !== 'idle' || isMoving())
    throw new LinkError('busy', 'the robot is moving: wait or stop it first');
}

function notReady(link: LinkState): LinkError {
  if (link.status === 'refused') return link.error;
  if (link.status === 'lost') return new LinkError('lost', 'the link is gone');
  if (link.status === 'stale') return new LinkError('boardSilent', 'the board does not answer');
  return link.status === 'identifying'
    ? new LinkError('busy', 'the board is being identified')
    : new LinkError('closed', 'the link is not open');
}

/** A packet for each frame of each group. Throws `outOfRange` where a slot is named twice or a group has no frame. */
export function frameCommands(groups: readonly SlotGroup[]): readonly (readonly FrameCommand[])[] {
  const slots = groups.map(({ slot }) => slot);
  const twice = slots.find((slot, at) => slots.indexOf(slot) !== at);
  if (twice !== undefined) throw new LinkError('outOfRange', `slot ${twice} is wanted twice`);
  return groups.map(({ slot, frames }) => {
    const frameCount = frames.length;
    if (frameCount === 0) throw new LinkError('outOfRange', 'an action group needs at least one frame');
    return frames.map((frame, frameIndex) => ({ kind: 'download', slot, frameCount, frameIndex, frame }));
  });
}

/** The servos in as many commands as they need, each of which fits into one packet. */
export function releaseCommands(
  servos: readonly number[],
  servosPerPacket: number,
  family: Family,
): readonly Extract<Command, { kind: 'release' }>[] {
  const commands = portions(servos, servosPerPacket).map(
    (some) => ({ kind: 'release', servos: some }) as const,
  );
  for (const command of commands) refuseUnfit(command, family);
  return commands;
}

export function portions(servos: readonly number[], size: number): readonly (readonly number[])[] {
  const count = Math.max(1, Math.ceil(servos.length / size));
  return Array.from({ length: count }, (_, index) => servos.slice(index * size, (index + 1) * size));
}
