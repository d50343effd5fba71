// What the controls of the servo panel do to servos: one alone, or with the ones it moves together with. Locked ones stay.

import { servoOf } from '#shared/profile/robot.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Pace } from '../../robot/moveTime.ts';
import { guessNow, servoViewOf, useStores, type Stores } from '../stores.ts';
import { freeOf } from './locks.ts';
import { isHeld, type ServoView, type Stand } from './servoView.ts';
import { moveGang, weightOf, type Gang, type GangMove, type Member } from './gang.ts';

export interface Hand {
  move(servo: number, position: number): void;
  /** To a place that no hand leads it to: its own time, unless one is set. */
  leap(servo: number, position: number): void;
  /** The same to a figure that was typed; who of those that move along keeps it from getting there, if any does. */
  place(servo: number, position: number): number | null;
  /** The same between two frames, while a pointer holds the slider. */
  drag(servo: number, position: number): void;
  /** Each to its own home; `durationMs` is left out for a leap. */
  home(servos: readonly number[], durationMs?: number): void;
}

export function useHand(): Hand {
  const stores = useStores();
  return {
    move: (servo, position) => send(stores, 'move', together(stores, servo, position).targets, 'hand'),
    leap: (servo, position) => send(stores, 'move', together(stores, servo, position).targets, 'leap'),
    place(servo, position) {
      const { targets, first } = together(stores, servo, position);
      send(stores, 'move', targets, 'leap');
      return first;
    },
    drag: (servo, position) => send(stores, 'drag', together(stores, servo, position).targets, 'hand'),
    home: (servos, durationMs) => send(stores, 'move', homes(stores, servos), durationMs ?? 'leap'),
  };
}

/** How far the servos have come together while they are handled in one way: not in a store, because a drag changes it in each frame. */
const gangs = new WeakMap<ServoView, Gang>();

/** The members of the gang that may move, `moved` among them; null where it moves alone. */
function membersOf({ robots }: Stores, view: ServoView, moved: number): readonly Member[] | null {
  if (view.selected.length < 2 || !view.selected.includes(moved)) return null;
  const { robot } = robots.current();
  return view.selected.flatMap((number) => {
    const servo = servoOf(robot, number);
    if (servo === undefined || isHeld(view, number)) return [];
    return [{ servo, weight: weightOf(view.together, view.weights, number, moved) }];
  });
}

function together(stores: Stores, servo: number, position: number): Pick<GangMove, 'targets' | 'first'> {
  const view = servoViewOf(stores);
  const members = membersOf(stores, view, servo);
  if (members === null) return { targets: [{ servo, position }], first: null };
  const move = moveGang(members, servo, position, standOf(stores, members), gangs.get(view) ?? null);
  gangs.set(view, move.gang);
  return move;
}

/** Where each was asked to be, else where it may stand. */
function standOf(stores: Stores, members: readonly Member[]): Stand {
  const stand: Record<number, number> = {};
  const motion = stores.device.motions();
  for (const { servo } of members) {
    const at = motion(servo.servo).target ?? guessNow(stores, servo);
    if (at !== null) stand[servo.servo] = at;
  }
  return stand;
}

function homes({ robots }: Stores, servos: readonly number[]): readonly ServoTarget[] {
  const own = robots.current().robot.servos.filter(({ servo }) => servos.includes(servo));
  return own.map(({ servo, home }) => ({ servo, position: home }));
}

function send(stores: Stores, how: 'move' | 'drag', targets: readonly ServoTarget[], pace: Pace): void {
  const { moveTime } = stores.view.getState();
  const free = freeOf(stores, targets);
  if (free.length > 0)
    stores.device[how](free, typeof pace === 'number' || moveTime === 'hand' ? pace : moveTime);
}
