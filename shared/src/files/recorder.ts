// From what a session tells to entries of a recording, and back to what they mean. Knows the session's events; keeps nothing
// but the link's last state.

import type { Family } from '../codec/families.ts';
import { parseCommand, parseReport } from '../codec/parse.ts';
import type { SessionState, Traffic } from '../robot/state.ts';
import type { Entry, Happening } from './recording.ts';

export type PacketEntry = Extract<Entry, { readonly bytes: Uint8Array }>;

export function entryOf(traffic: Traffic): PacketEntry {
  const { atMs, bytes } = traffic;
  if ('noise' in traffic) return { atMs, mark: traffic.noise, bytes };
  return { atMs, mark: traffic.direction === 'out' ? 'sent' : 'received', bytes };
}

export function trafficOf({ atMs, mark, bytes }: PacketEntry, family: Family): Traffic {
  if (mark === 'garbage' || mark === 'truncated') return { atMs, direction: 'in', bytes, noise: mark };
  const packet = { command: bytes[3] ?? 0, params: bytes.subarray(4) };
  if (mark === 'received') return { atMs, direction: 'in', bytes, report: parseReport(packet, family) };
  return { atMs, direction: 'out', bytes, command: parseCommand(packet) };
}

const LINK_HAPPENINGS: Readonly<Partial<Record<SessionState['link']['status'], Happening>>> = {
  ready: 'opened',
  lost: 'lost',
  closed: 'closed',
};

type Watched = Pick<SessionState, 'link' | 'latch'>;

/** Gives what happened between one snapshot and the next; the first is compared with a closed link. */
export function createHappeningsReader(): (snapshot: Watched) => readonly Happening[] {
  let link: Happening = 'closed';
  let latch: SessionState['latch'] = null;

  return (snapshot) => {
    const happened: Happening[] = [];
    const next = LINK_HAPPENINGS[snapshot.link.status] ?? link;
    if (next !== link) happened.push(next);
    if (snapshot.latch !== latch && isOurStop(snapshot.latch)) happened.push('stopped');
    else if (latch === null && snapshot.latch !== null) happened.push('latched');
    // A link that is closed takes its latch along; nobody allowed motion.
    if (latch !== null && snapshot.latch === null && next === 'opened') happened.push('resumed');
    link = next;
    latch = snapshot.latch;
    return happened;
  };
}

/** Each stop from here begins with a latch of its own, also where one is set already. */
function isOurStop(latch: SessionState['latch']): boolean {
  return latch?.stop === 'sending' && (latch.reason === 'pressed' || latch.reason === 'battery');
}
