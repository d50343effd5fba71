// Keeps the robot at hand the one of the connected board, and says when what a shared link must know of it is new: once the
// link is ready, and whenever the robot changes. Knows no session.

import type { Robot } from '#shared/actions/robot/robot.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import type { SessionState } from '#shared/session/state.ts';
import type { RobotStore } from './robots.ts';

/** `tell` gets a robot that the link does not know yet. Returns what is to be called with each state of the session. */
export function followRobot(
  robots: RobotStore,
  tell: (robot: Robot) => void,
): (snapshot: SessionState) => void {
  let { family, link } = INITIAL_STATE;
  let told: Robot | null = null;

  function settle(): void {
    // May change the robot at hand, and with it call this again first.
    if (family.id !== 'unknown') robots.takeUpFor(family.id);
    const robot = link.status === 'ready' ? robots.current().robot : null;
    if (robot !== null && robot !== told) tell(robot);
    told = robot;
  }

  robots.store.subscribe(settle);
  return (snapshot) => {
    ({ family, link } = snapshot);
    settle();
  };
}
