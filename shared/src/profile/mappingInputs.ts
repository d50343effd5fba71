// What fingers do at one moment, as plain numbers, and how a stick's way becomes a wish: dead zone, curve, smoothing. Pure; knows
// no browser, no servo.

import type { Feel, Input } from './mapping.ts';

export interface Inputs {
  /** -1 to 1 each. */
  readonly axes: readonly number[];
  /** 0 to 1 each: triggers know how far. */
  readonly buttons: readonly number[];
  /** Codes of the keys that are down. */
  readonly keys: ReadonlySet<string>;
}

export const NO_INPUTS: Inputs = { axes: [], buttons: [], keys: new Set() };

/** From here on a button or half an axis counts as pressed. */
const PRESSED = 0.5;

/** How far an input is from rest, -1 to 1. What is not there rests. */
export function valueOf(input: Input, { axes, buttons, keys }: Inputs): number {
  if (input.kind === 'key') return keys.has(input.code) ? 1 : 0;
  if (input.kind === 'button') return clamped(buttons[input.index] ?? 0, 0, 1);
  const way = clamped(axes[input.index] ?? 0, -1, 1);
  if (input.side === 'whole') return way;
  return Math.max(0, input.side === 'plus' ? way : -way);
}

export const isPressed = (input: Input, inputs: Inputs): boolean =>
  Math.abs(valueOf(input, inputs)) > PRESSED;

/** What a finger has moved on the pad since `before`: a button, or the half of an axis; null while nothing is clear. */
export function movedInput(before: Inputs, now: Inputs): Input | null {
  const button = now.buttons.findIndex((value, at) => value - (before.buttons[at] ?? 0) > PRESSED);
  if (button >= 0) return { kind: 'button', index: button };
  const axis = now.axes.findIndex((value, at) => Math.abs(value - (before.axes[at] ?? 0)) > PRESSED);
  if (axis < 0) return null;
  const side = (now.axes[axis] ?? 0) > (before.axes[axis] ?? 0) ? 'plus' : 'minus';
  return { kind: 'axis', index: axis, side };
}

/** An input's way as the person wants it felt: odd, growing, 0 in the dead zone, full at the end. */
export function shaped(way: number, { deadZonePercent, curvePercent }: Feel): number {
  const dead = deadZonePercent / 100;
  const past = Math.max(0, Math.abs(way) - dead) / (1 - dead);
  const bend = curvePercent / 100;
  return Math.sign(way) * ((1 - bend) * past + bend * past ** 3);
}

/** Nearer than this is there: an exponential approach would never end. */
const ARRIVED = 1e-3;

/** From `from` towards `to`, never past it. */
export function smoothed(from: number, to: number, dtMs: number, { smoothingMs }: Feel): number {
  if (smoothingMs === 0) return to;
  const next = from + (to - from) * (1 - Math.exp(-dtMs / smoothingMs));
  return Math.abs(to - next) < ARRIVED ? to : next;
}

export function clamped(value: number, min: number, max: number): number {
  return Math.min(max, Math.max(min, value));
}
