// The mapping a robot has until somebody makes another: sticks, triggers and bumpers for its first six servos in the order of an
// arm (servo 1 the gripper, 6 the base), and a pair of keys for each. Moves nothing until it is switched on. T is nobody's: it keeps
// what the hand has just done.

import type { Binding, Feel, Input, Mapping } from './mapping.ts';
import type { Robot } from './robot.ts';

export const READY_FEEL: Feel = { deadZonePercent: 15, curvePercent: 30, smoothingMs: 80, speedPercent: 100 };

/** Of a servo's range, in a second: slow enough to let go in time. */
const RANGE_PERCENT_PER_S = 40;

const axis = (index: number): Input => ({ kind: 'axis', index, side: 'whole' });
const button = (index: number): Input => ({ kind: 'button', index });
const key = (code: string): Input => ({ kind: 'key', code });

/** What turns the servo at that place of the list one way, and what the other; numbers are those of the standard pad. */
const TURNS: readonly { readonly more: readonly Input[]; readonly less: readonly Input[] }[] = [
  { more: [button(7), key('KeyQ')], less: [button(6), key('KeyA')] },
  { more: [button(5), key('KeyW')], less: [button(4), key('KeyS')] },
  { more: [axis(2), key('KeyE')], less: [key('KeyD')] },
  { more: [key('KeyR')], less: [axis(3), key('KeyF')] },
  { more: [key('KeyY')], less: [axis(1), key('KeyH')] },
  { more: [axis(0), key('KeyU')], less: [key('KeyJ')] },
];

/** B on most pads, the circle on some. */
const STOP: Binding = { input: button(1), action: { kind: 'stop' } };

export function readyMapping({ servos }: Robot): Mapping {
  const turning = servos.slice(0, TURNS.length).flatMap(({ servo, min, max }, at): readonly Binding[] => {
    const unitsPerS = usualUnitsPerS({ min, max });
    const turn = (input: Input, sign: number): Binding => ({
      input,
      action: { kind: 'rate', servo, unitsPerS: sign * unitsPerS },
    });
    const { more = [], less = [] } = TURNS[at] ?? {};
    return [...more.map((input) => turn(input, 1)), ...less.map((input) => turn(input, -1))];
  });
  return { bindings: [...turning, STOP], feel: READY_FEEL };
}

export function usualUnitsPerS({ min, max }: { readonly min: number; readonly max: number }): number {
  return Math.max(1, Math.round(((max - min) * RANGE_PERCENT_PER_S) / 100));
}
