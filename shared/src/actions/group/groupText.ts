// An action group as text with a version, for storage. Reading trusts nothing: whatever is not exactly a group comes back
// as null, and the caller keeps the text. Knows no place to store anything and no board's limits.

import type { Frame, ServoTarget } from '../../protocol/commands.ts';
import { sortedTargets, type ActionGroup } from './group.ts';

const VERSION = 1;
const MAX_NAME = 64;
/** Far above any board; keeps a damaged file from filling the memory. */
const MAX_FRAMES = 10_000;

export function groupToText(group: ActionGroup): string {
  const frames = group.frames.map(({ durationMs, targets }) => ({ durationMs, targets }));
  return JSON.stringify({ version: VERSION, name: group.name, unit: group.unit, frames });
}

/** null where the text is no group of this version. */
export function groupFromText(text: string): ActionGroup | null {
  try {
    return readGroup(JSON.parse(text));
  } catch {
    return null;
  }
}

function readGroup(value: unknown): ActionGroup | null {
  if (!isRecord(value) || value.version !== VERSION) return null;
  const { name, unit, frames } = value;
  if (typeof name !== 'string' || name.length > MAX_NAME) return null;
  if (unit !== 'us' && unit !== 'steps') return null;
  if (!Array.isArray(frames) || frames.length > MAX_FRAMES) return null;
  const read = frames.map(readFrame);
  if (!read.every((frame) => frame !== null)) return null;
  return {
    name,
    unit,
    frames: read.map((frame, index) => ({ id: index + 1, ...frame })),
    nextId: read.length + 1,
  };
}

function readFrame(value: unknown): Frame | null {
  if (!isRecord(value)) return null;
  const { durationMs, targets } = value;
  if (!isCount(durationMs) || !Array.isArray(targets)) return null;
  const read = targets.map(readTarget);
  return read.every((target) => target !== null) ? { durationMs, targets: sortedTargets(read) } : null;
}

function readTarget(value: unknown): ServoTarget | null {
  if (!isRecord(value)) return null;
  const { servo, position } = value;
  return isCount(servo) && isCount(position) ? { servo, position } : null;
}

function isCount(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 0 && (value as number) <= 0xffff;
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
