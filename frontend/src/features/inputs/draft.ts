// A binding while it is being written: every field has a value, whatever the binding will do. Knows no drawing.

import {
  FASTEST_UNITS_PER_S,
  type Action,
  type Binding,
  type Input,
  usualUnitsPerS,
} from '#shared/profile/mapping.ts';
import type { PoseRef } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { GENTLE_MOVE_MS } from '../../robot/moveTime.ts';

export interface Draft {
  /** Its place in the list; null for a new one. */
  readonly at: number | null;
  readonly input: Input;
  readonly kind: Action['kind'];
  readonly servo: number;
  /** Always positive; `isReversed` tells the direction. */
  readonly unitsPerS: number;
  readonly isReversed: boolean;
  readonly slot: number;
  readonly pose: PoseRef;
  readonly durationMs: number;
}

/** A stick pushed to its minus side is meant to make it more there. */
export function draftFor(input: Input, { servos }: Robot): Draft {
  const [first] = servos;
  const unitsPerS = first === undefined ? FASTEST_UNITS_PER_S : usualUnitsPerS(first);
  const isReversed = input.kind === 'axis' && input.side === 'minus';
  return { at: null, input, kind: 'rate', servo: first?.servo ?? 1, unitsPerS, isReversed, ...UNTOLD };
}

/** Of what the action does not say. */
const UNTOLD = { slot: 0, pose: 'home', durationMs: GENTLE_MOVE_MS } as const;

export function draftOf(at: number, { input, action }: Binding, robot: Robot): Draft {
  const draft = { ...draftFor(input, robot), at, kind: action.kind };
  if (action.kind === 'run') return { ...draft, slot: action.slot };
  if (action.kind === 'pose') return { ...draft, pose: action.pose, durationMs: action.durationMs };
  if (action.kind === 'stop') return draft;
  if (action.kind === 'position') return { ...draft, servo: action.servo, isReversed: action.isReversed };
  const { servo, unitsPerS } = action;
  return { ...draft, servo, unitsPerS: Math.abs(unitsPerS), isReversed: unitsPerS < 0 };
}

/** Servos take all of an axis, the rest the side that was pushed. */
export function bindingFrom({ input, kind, ...draft }: Draft): Binding {
  const { servo, isReversed, slot, pose, durationMs } = draft;
  if (kind === 'run') return { input, action: { kind, slot } };
  if (kind === 'pose') return { input, action: { kind, pose, durationMs } };
  if (kind === 'stop') return { input, action: { kind } };
  const whole: Input = input.kind === 'axis' ? { ...input, side: 'whole' } : input;
  if (kind === 'position') return { input: whole, action: { kind, servo, isReversed } };
  const unitsPerS = isReversed ? -draft.unitsPerS : draft.unitsPerS;
  return { input: whole, action: { kind, servo, unitsPerS } };
}
