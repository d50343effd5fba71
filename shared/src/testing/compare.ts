// Two lists of packets side by side: what is in both, what differs in its values, what only one of them has. Knows packets by
// command number and LEN; not who sent them.

import { toHex } from '../codec/packet.ts';
import type { PacketEntry } from '../files/recorder.ts';

type Verdict = 'same' | 'different' | 'missing' | 'extra';

export interface Row {
  readonly atMs: number;
  readonly verdict: Verdict;
  /** Null where it is `extra`. */
  readonly recorded: string | null;
  /** Null where it is `missing`. */
  readonly replayed: string | null;
  /** How much later than recorded; 0 where there is only one. */
  readonly laterMs: number;
}

type Tally = Readonly<Record<Verdict, number>>;

/** Longer than any board works on one packet (a flash erase at its worst). */
const WINDOW_MS = 2_500;

/** Both in the order of time. Pairs packets of one kind in that order, those further apart than 2.5 s not at all. */
export function compare(recorded: readonly PacketEntry[], replayed: readonly PacketEntry[]): readonly Row[] {
  const waiting = grouped(replayed);
  const next = new Map<string, number>();
  const taken = new Set<PacketEntry>();

  function partnerOf(entry: PacketEntry): PacketEntry | null {
    const kind = kindOf(entry);
    const candidates = waiting.get(kind) ?? [];
    let at = next.get(kind) ?? 0;
    while ((candidates[at]?.atMs ?? Infinity) < entry.atMs - WINDOW_MS) at += 1;
    const candidate = candidates[at];
    const isNear = candidate !== undefined && candidate.atMs <= entry.atMs + WINDOW_MS;
    next.set(kind, isNear ? at + 1 : at);
    return isNear ? candidate : null;
  }

  const rows = recorded.map((entry) => {
    const partner = partnerOf(entry);
    if (partner !== null) taken.add(partner);
    return row(entry, partner);
  });
  const extra = replayed.filter((entry) => !taken.has(entry)).map((entry) => row(null, entry));
  return [...rows, ...extra].sort((a, b) => a.atMs - b.atMs);
}

export function tally(rows: readonly Row[]): Tally {
  const counts = { same: 0, different: 0, missing: 0, extra: 0 };
  for (const { verdict } of rows) counts[verdict] += 1;
  return counts;
}

function grouped(entries: readonly PacketEntry[]): ReadonlyMap<string, readonly PacketEntry[]> {
  const groups = new Map<string, PacketEntry[]>();
  for (const entry of entries) {
    const group = groups.get(kindOf(entry));
    if (group === undefined) groups.set(kindOf(entry), [entry]);
    else group.push(entry);
  }
  return groups;
}

/** Command number and LEN: what tells kinds of packets apart on this wire. */
function kindOf({ bytes }: PacketEntry): string {
  return `${bytes[3] ?? ''}/${bytes.length}`;
}

function row(recorded: PacketEntry | null, replayed: PacketEntry | null): Row {
  const [before, after] = [recorded && toHex(recorded.bytes), replayed && toHex(replayed.bytes)];
  const both = recorded !== null && replayed !== null;
  return {
    atMs: recorded?.atMs ?? replayed?.atMs ?? 0,
    verdict: both ? (before === after ? 'same' : 'different') : recorded ? 'missing' : 'extra',
    recorded: before,
    replayed: after,
    laterMs: both ? Math.round(replayed.atMs - recorded.atMs) : 0,
  };
}
