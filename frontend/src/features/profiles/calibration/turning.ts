// What shows a servo's direction: the way home that it is on, or a little turn away from home and, once it stands there, back, which
// ends early where nothing may move any longer. Knows no session.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { Clock } from '#shared/clock.ts';
import type { ServoMotion } from '#shared/robot/state.ts';

export interface Turning {
  readonly clock: Clock;
  motion(): ServoMotion;
  mayMove(): boolean;
  move(position: number, durationMs: number): void;
}

/** `away` is what is looked at; `ended`: something else took the servo or stopped it. */
export type TurnPhase = 'away' | 'back' | 'done' | 'ended';

const SHARE_OF_SIDE = 0.3;
/** Of a horn, by whoever looks for it. */
const SEEN_DEGREES = 3;

/** The side of home that has more room. */
export const sideOf = ({ min, home, max }: RobotServo): 1 | -1 => (max - home >= home - min ? 1 : -1);

/** A share of that side, and of a short one as much as is seen; null where its limits leave less than that. */
export function awayFrom(servo: RobotServo): number | null {
  const room = Math.max(servo.max - servo.home, servo.home - servo.min);
  const seen = Math.ceil(SEEN_DEGREES / servo.degreesPerUnit);
  if (room < seen) return null;
  return Math.round(servo.home + sideOf(servo) * Math.max(room * SHARE_OF_SIDE, seen));
}

/** The side it goes to on a way home that is long enough to be seen; 0 where it goes on none. */
export function homeward(
  { home, degreesPerUnit }: RobotServo,
  { target, estimated }: Pick<ServoMotion, 'target' | 'estimated'>,
): 1 | 0 | -1 {
  const way = target === home && estimated !== null ? home - estimated : 0;
  if (Math.abs(way) * degreesPerUnit < SEEN_DEGREES) return 0;
  return way > 0 ? 1 : -1;
}

const TURN_MS = 900;
/** To see where it stands before it comes back. */
const STAND_MS = 400;
const LOOK_EACH_MS = 50;

/** Returns what ends it; ending twice is harmless. */
export function startTurning(
  { clock, motion, mayMove, move }: Turning,
  { home, away }: { readonly home: number; readonly away: number },
  hear: (phase: TurnPhase) => void,
): () => void {
  let cancel = (): void => undefined;

  function go(to: number, phase: TurnPhase, then: () => void): void {
    if (!mayMove()) return hear('ended');
    hear(phase);
    move(to, TURN_MS);
    cancel = clock.after(TURN_MS, () => untilThere(to, then));
  }

  function untilThere(to: number, then: () => void): void {
    const { target, estimated } = motion();
    if (!mayMove() || (target !== null && Math.abs(target - to) > 1)) return hear('ended');
    cancel =
      target === estimated
        ? clock.after(STAND_MS, then)
        : clock.after(LOOK_EACH_MS, () => untilThere(to, then));
  }

  go(away, 'away', () => go(home, 'back', () => hear('done')));
  return () => cancel();
}
