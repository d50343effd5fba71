// Keeps the robot at hand the one of the connected board, and keeps it and a shared link at one about its limits: what changed here
// is told, what others said stands until then. Knows no session.

import { limitsApart, type NamedLimits, type Robot } from '#shared/actions/robot/robot.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import type { SessionState } from '#shared/session/state.ts';
import type { RobotStore } from './robots.ts';

export interface RobotOfLink {
  /** A robot that the link does not know yet. */
  tell(robot: Robot): void;
  /** The link holds these servos to other limits than the robot at hand has. */
  heldOtherwise(limits: readonly NamedLimits[]): void;
}

/** Returns what is to be called with each state of the session. */
export function followRobot(
  robots: RobotStore,
  { tell, heldOtherwise }: RobotOfLink,
): (snapshot: SessionState) => void {
  let { family, link, limitsHeld } = INITIAL_STATE;
  let wasReady = false;
  let heard = limitsHeld;
  /** What the link knows, or knew before it was away. */
  let told: Robot | null = null;

  function settle(): void {
    // May change the robot at hand, and with it call this again first.
    if (family.id !== 'unknown') robots.takeUpFor(family.id);
    const isReady = link.status === 'ready';
    const isNew = isReady && !wasReady;
    wasReady = isReady;
    if (isReady) agree(robots.current().robot, isNew);
  }

  function agree(robot: Robot, isNew: boolean): void {
    const isChanged = told !== null && told !== robot;
    const isHeard = isNew ? !isChanged : limitsHeld !== heard;
    const isTold = !isNew && told === robot;
    told = robot;
    heard = limitsHeld;
    const apart = isHeard ? limitsApart(robot, limitsHeld) : [];
    if (apart.length > 0) heldOtherwise(apart);
    else if (!isTold) tell(robot);
  }

  robots.store.subscribe(settle);
  return (snapshot) => {
    ({ family, link, limitsHeld } = snapshot);
    settle();
  };
}
