// Where the servos of a driven robot are by its latest report: the target that was commanded last, and the estimated or reported position,
// as a person counts, without the servo's trim. Pure.

import type { RobotServo } from '#shared/profile/robot.ts';
import type { MotionState } from './drive.generated.ts';

export interface ServoPlace {
  readonly target: number | null;
  readonly estimated: number | null;
}

const NOWHERE: ServoPlace = { target: null, estimated: null };

type Trimmed = Pick<RobotServo, 'servo' | 'trim'>;

export function placeOf(motion: MotionState | null, { servo, trim }: Trimmed): ServoPlace {
  const { target, estimated } = onBoardAt(motion, servo);
  const untrimmed = (onBoard: number | null): number | null => (onBoard === null ? null : onBoard - trim);
  return { target: untrimmed(target), estimated: untrimmed(estimated) };
}

function onBoardAt(motion: MotionState | null, servo: number): ServoPlace {
  if (motion === null) return NOWHERE;
  const way = motion.servos.find((one) => one.servo === servo);
  const reported = motion.reported.find((one) => one.servo === servo && one.isCurrent)?.position ?? null;
  if (way === undefined) return { target: reported, estimated: reported };
  return { target: way.goal ?? way.target, estimated: reported ?? estimateOf(way) };
}

/** Straight from its start to its target; unknown on the way from an unknown place. */
function estimateOf({ start, target, begunMsAgo, durationMs }: MotionState['servos'][number]): number | null {
  const share = durationMs <= 0 ? 1 : Math.min(1, Math.max(0, begunMsAgo / durationMs));
  if (share === 1) return target;
  return start === null ? null : start + (target - start) * share;
}

/** Of all servos whose position is known. */
export function poseOf(motion: MotionState | null, servos: readonly Trimmed[]): ReadonlyMap<number, number> {
  return new Map(
    servos.flatMap((servo) => {
      const { estimated } = placeOf(motion, servo);
      return estimated === null ? [] : [[servo.servo, estimated] as const];
    }),
  );
}
