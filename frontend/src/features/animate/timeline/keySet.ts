// A set of keys of the action group, by their names in the document. Pure; knows no group.

import type { KeyRef } from '#shared/group/tracks.ts';

/** `frameId/servo`, so that a key is found in it at once, however many there are. */
export type KeyName = `${number}/${number}`;
export type KeySet = ReadonlySet<KeyName>;

export const NO_KEYS: KeySet = new Set();

export const keyName = ({ frameId, servo }: KeyRef): KeyName => `${frameId}/${servo}`;

/** Made once for each list: thousands of names are not written again after each edit. */
const made = new WeakMap<readonly KeyRef[], KeySet>();
const madeOf = new WeakMap<KeySet, readonly KeyRef[]>();
/** And what each says, read once. */
const read = new WeakMap<KeySet, FramesByServo>();

type FramesByServo = ReadonlyMap<number, ReadonlySet<number>>;

export function keySet(refs: readonly KeyRef[]): KeySet {
  const keys = made.get(refs) ?? new Set(refs.map(keyName));
  isMadeOf(keys, refs);
  return keys;
}

/** `refs` are the keys of the set. */
export function isMadeOf(keys: KeySet, refs: readonly KeyRef[]): void {
  made.set(refs, keys);
  madeOf.set(keys, refs);
}

/** In which frames a servo's key is in the set. */
export function framesByServo(keys: KeySet): FramesByServo {
  const frames = read.get(keys) ?? framesNamedIn(keys);
  read.set(keys, frames);
  return frames;
}

function framesNamedIn(keys: KeySet): FramesByServo {
  const frames = new Map<number, Set<number>>();
  for (const { frameId, servo } of refsOf(keys)) {
    const own = frames.get(servo);
    if (own === undefined) frames.set(servo, new Set([frameId]));
    else own.add(frameId);
  }
  return frames;
}

export const refsOf = (keys: KeySet): readonly KeyRef[] => madeOf.get(keys) ?? namedIn(keys);

function namedIn(keys: KeySet): readonly KeyRef[] {
  return [...keys].map((name) => {
    const [frameId = 0, servo = 0] = name.split('/').map(Number);
    return { frameId, servo };
  });
}

/** `adds`: beside those that are in it; `toggles`: the same, and all of them out where all were in. */
export type SelectMode = 'replaces' | 'adds' | 'toggles';

export function withKeys(before: KeySet, refs: readonly KeyRef[], mode: SelectMode): KeySet {
  const wanted = refs.map(keyName);
  if (mode === 'replaces') return new Set(wanted);
  const areIn = wanted.length > 0 && wanted.every((name) => before.has(name));
  if (mode === 'adds' || !areIn) return new Set([...before, ...wanted]);
  const out = new Set(wanted);
  return new Set([...before].filter((name) => !out.has(name)));
}
