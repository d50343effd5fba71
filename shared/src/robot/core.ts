// What the operations of one session share: the parts they talk through, and the rules on what may begin now. Knows no
// operation by itself.

import type { Clock } from '../clock.ts';
import type { Family } from '../codec/families.ts';
import type { Exchange } from './exchange.ts';
import type { Lanes } from './queue.ts';
import { isWatching, notDriving } from './lease.ts';
import { LinkError } from './linkError.ts';
import type { RobotEstimate } from './estimate.ts';
import type { Activity, LinkState } from './state.ts';
import type { SessionStore } from './store.ts';
import type { SharedCommands, Withheld } from './transport.ts';

export interface Core {
  readonly family: Family;
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly robot: RobotEstimate;
  readonly lanes: Lanes;
  readonly exchange: Exchange;
  /** As many as the board takes in one packet and the link carries. */
  readonly servosPerMove: number;
  /** A shared link does these itself. */
  readonly commands: SharedCommands | undefined;
  /** A move or a stop of ours is still to leave. */
  unsettled(): boolean;
}

/** Whether the board knows it is another question. */
export function requireCarried({ store }: Core, kind: Withheld): void {
  if (store.state.withheld.includes(kind))
    throw new LinkError('notOnThisCable', `this link does not carry "${kind}"`);
}

export function setActivity({ store }: Core, activity: Activity): void {
  store.update({ activity });
}

/** The link is there and the board is not deaf with flash work (S41). */
export function requireReady({ state: { link, activity } }: SessionStore): void {
  if (link.status !== 'ready') throw notReady(link);
  if (activity.kind === 'downloading' || activity.kind === 'erasing') {
    throw new LinkError('busy', `${activity.kind}: wait for its end or cancel it`);
  }
}

/** The line is there, and so was the board: questions may go out, also to hear whether it is still there. */
export function requireLine(store: SessionStore): void {
  if (store.state.link.status !== 'stale') requireReady(store);
}

/** Additionally a question does no harm: on some boards any of them ends a running group, unsaid (L8). */
export function requireQuestion({ family, store }: Core): void {
  requireReady(store);
  if (family.queryKillsRun && store.state.activity.kind === 'running')
    throw new LinkError('busy', 'asking would end the running group: end it first');
}

/** The board is ready, nobody has pressed STOP since the last Resume, and nobody else drives. */
export function requireReleased(core: Core): void {
  requireReady(core.store);
  const { latch, lease } = core.store.state;
  if (latch !== null) throw new LinkError('latched', 'stopped: resume first');
  if (isWatching(lease)) throw notDriving(lease);
}

/**
 * Additionally the robot is at rest and stays so: flash work freezes the servos and then lets them jump (S29, S39), and a
 * packet that comes meanwhile overwrites what is being stored (S11).
 */
export function requireRest(core: Core): void {
  requireReleased(core);
  if (core.store.state.activity.kind !== 'idle' || core.robot.moving() || core.unsettled()) {
    throw new LinkError('busy', 'the robot is moving: wait or stop it first');
  }
}

function notReady(link: LinkState): LinkError {
  if (link.status === 'refused') return link.error;
  if (link.status === 'lost') return new LinkError('lost', 'the link is gone');
  if (link.status === 'stale') return new LinkError('boardSilent', 'the board does not answer');
  return link.status === 'identifying'
    ? new LinkError('busy', 'the board is being asked who it is')
    : new LinkError('closed', 'the link is not open');
}
