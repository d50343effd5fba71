// A set of keys of the action group, by their names in the document. Pure; knows no group.

import type { KeyRef } from '#shared/actions/group/tracks.ts';

/** `frameId/servo`, so that a key is found in it at once, however many there are. */
export type KeyName = `${number}/${number}`;
export type KeySet = ReadonlySet<KeyName>;

export const NO_KEYS: KeySet = new Set();

export const keyName = ({ frameId, servo }: KeyRef): KeyName => `${frameId}/${servo}`;

/** What a set was made of: thousands of names are not read again after each edit. */
const made = new WeakMap<KeySet, readonly KeyRef[]>();

export function keySet(refs: readonly KeyRef[]): KeySet {
  const keys = new Set(refs.map(keyName));
  if (keys.size === refs.length) made.set(keys, refs);
  return keys;
}

export const refsOf = (keys: KeySet): readonly KeyRef[] => made.get(keys) ?? namedIn(keys);

function namedIn(keys: KeySet): readonly KeyRef[] {
  return [...keys].map((name) => {
    const [frameId, servo] = name.split('/').map(Number);
    return { frameId: frameId ?? 0, servo: servo ?? 0 };
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
