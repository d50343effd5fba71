// A show as a list of cues: who takes part in each, who is missing, and what GO asks for. Pure.

import type { FleetCue, FleetRobot, FleetRunWish } from '#shared/client/http.generated.ts';
import { takesMotion } from './robots.ts';
import { slotOf } from './slots.ts';

export interface CueState {
  readonly ready: readonly FleetRobot[];
  /** Of the cue's robots, but they take no motion now, or have no group of that name. */
  readonly missing: readonly FleetRobot[];
}

export function cueState({ name, robots: group }: FleetCue, robots: readonly FleetRobot[]): CueState {
  const all = robots.filter(({ groups }) => group === '' || groups.includes(group));
  const has = ({ slots }: FleetRobot): boolean => slots.some((slot) => slot.name === name);
  const ready = all.filter((robot) => has(robot) && takesMotion(robot));
  return { ready, missing: all.filter((robot) => !ready.includes(robot)) };
}

/** All that are ready start together. Null where none is. */
export function wishOf(cue: FleetCue, robots: readonly FleetRobot[]): FleetRunWish | null {
  const { ready } = cueState(cue, robots);
  if (ready.length === 0) return null;
  return {
    name: cue.name,
    runs: ready.map((robot) => ({ robot: robot.id, slot: slotOf(robot, cue.name) })),
    times: cue.times,
    together: ready.length > 1,
    stopsOthers: cue.stopsOthers,
  };
}
