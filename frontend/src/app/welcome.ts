// The page's own simulated robot stands up gently when the page opens, so that its pose is known; on the first visit it then makes small
// movements until the first key or touch. The one at a gateway stands up on the first visit only and rests, because a gateway stops the
// robot of a driver who leaves while it moves. A real robot never moves by itself.

import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { rescaled } from '#shared/profile/units.ts';
import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import type { RobotStore } from '../features/profiles/robots.ts';
import type { Device, DeviceState } from '../robot/device.ts';
import { GENTLE_MOVE_MS } from '../robot/moves.ts';
import { startHindrance } from '../robot/readiness.ts';

const BREATH_MS = 2_000;
/** Between two breaths: the battery of a robot that moves is not read. */
const REST_MS = 3_500;
/** Of the way to the nearer limit. */
const DEPTH = 0.05;

interface Welcome {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly clock: Clock;
  readonly isFirstVisit: boolean;
  /** Aborted by the first key or touch. */
  readonly touched: AbortSignal;
  isWatched(): boolean;
}

export function welcome({ device, robots, clock, isFirstVisit, touched, isWatched }: Welcome): void {
  let stand: readonly ServoTarget[] = [];
  let isOut = false;
  let cancel = (): void => undefined;

  function standUp(): void {
    stand = standing();
    const isSent = stand.every(({ servo }) => device.motion(servo).target !== null);
    if (!isSent) device.move(stand, GENTLE_MOVE_MS);
    breatheLater();
  }

  function breatheLater(): void {
    if (!isFirstVisit || touched.aborted || device.store.getState().way?.kind !== 'simulated') return;
    cancel = clock.after(BREATH_MS + REST_MS, () => {
      if (startHindrance(device.store.getState().snapshot) === null && isWatched()) {
        isOut = !isOut;
        device.move(isOut ? leaning(stand) : stand, BREATH_MS);
      }
      breatheLater();
    });
  }

  /** A servo that was moved before stays where it was sent. */
  function standing(): readonly ServoTarget[] {
    const { robot } = robots.current();
    return robot.servos.map((one) => ({
      servo: one.servo,
      position: device.motion(one.servo).target ?? standingAt(robot, one),
    }));
  }

  function leaning(from: readonly ServoTarget[]): readonly ServoTarget[] {
    const { servos } = robots.current().robot;
    return from.map(({ servo, position }, index) => {
      const limits = servos.find((one) => one.servo === servo) ?? { min: position, max: position };
      const room = Math.max(0, Math.min(position - limits.min, limits.max - position)) * DEPTH;
      return { servo, position: Math.round(position + (index % 2 === 0 ? room : -room)) };
    });
  }

  function begin({ way, snapshot }: DeviceState): void {
    const isWelcome =
      way?.kind === 'simulated' || (way?.isSimulated === true && isFirstVisit && !touched.aborted);
    if (!isWelcome || startHindrance(snapshot) !== null || snapshot.battery.kind !== 'read') return;
    stopListening();
    standUp();
  }
  const stopListening = device.store.subscribe(begin);
  touched.addEventListener('abort', () => cancel());
  begin(device.store.getState());
}

/** In microseconds, by servo: each link of the arm stands at an angle to the next one. */
const ARM = [1200, 1500, 1950, 2050, 1150, 1500];

function standingAt({ body, board }: Robot, { servo, min, max, home }: RobotServo): number {
  const position = body === 'arm' ? ARM[servo - 1] : undefined;
  if (position === undefined) return home;
  return Math.min(max, Math.max(min, rescaled(position, 'us', FAMILIES[board].unit)));
}
