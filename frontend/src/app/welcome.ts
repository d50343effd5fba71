// The first visit: a simulated robot stands up, and the page's own breathes until the first touch of a key or pointer. A gateway may have
// the robot stopped for a driver who leaves while it moves, so its simulated robot rests. A real robot is left alone.

import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import type { RobotStore } from '../features/profiles/robots.ts';
import type { Device, DeviceState } from '../robot/device.ts';
import { GENTLE_MOVE_MS } from '../robot/moves.ts';
import { startHindrance } from '../robot/readiness.ts';

const BREATH_MS = 2_000;
/** Between two breaths: the battery of a robot that moves is not asked for. */
const REST_MS = 3_500;
/** Of the way to the nearer limit. */
const DEPTH = 0.05;
const TOUCHES = ['pointerdown', 'keydown', 'wheel'] as const;

interface Welcome {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly clock: Clock;
  readonly page: Pick<Window, 'addEventListener' | 'removeEventListener'>;
  isWatched(): boolean;
  noteVisit(): void;
}

export function welcome({ device, robots, clock, page, isWatched, noteVisit }: Welcome): void {
  const since = new AbortController();
  let breaths = 0;
  let cancel = (): void => undefined;

  function leave(): void {
    since.abort();
    cancel();
    stopListening();
    noteVisit();
  }

  function breathe(): void {
    const { way, snapshot } = device.store.getState();
    const isAlive = way?.isSimulated === true && startHindrance(snapshot) === null;
    if (isAlive && isWatched()) {
      device.move(breath(robots.current().robot.servos, breaths), breaths === 0 ? GENTLE_MOVE_MS : BREATH_MS);
      breaths += 1;
    }
    if (way?.kind === 'simulated') cancel = clock.after(BREATH_MS + REST_MS, breathe);
  }

  function begin({ way, snapshot }: DeviceState): void {
    if (way === null || startHindrance(snapshot) !== null || snapshot.battery.kind !== 'read') return;
    stopListening();
    breathe();
  }
  const stopListening = device.store.subscribe(begin);
  begin(device.store.getState());
  for (const touch of TOUCHES) page.addEventListener(touch, leave, { capture: true, signal: since.signal });
}

/** First to home, then a little off and back. */
function breath(servos: readonly RobotServo[], count: number): readonly ServoTarget[] {
  const share = count % 2 === 0 ? 0 : DEPTH;
  return servos.map(({ servo, home, min, max }, index) => {
    const room = Math.min(home - min, max - home) * share;
    return { servo, position: Math.round(home + (index % 2 === 0 ? room : -room)) };
  });
}
