// What a simulated board answers to the packets of a recording, sent at their recorded times, in virtual time. Knows the board
// by its public face.

import { FAMILIES } from '../codec/families.ts';
import { createReceiver } from '../robot/channelLink.ts';
import { createBoard, type BoardOptions } from '../simulator/board.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { createVirtualClock } from './virtualClock.ts';
import type { PacketEntry } from '../files/recorder.ts';
import type { Entry } from '../files/recording.ts';

/** On for so long already that it serves commands and knows its battery. */
const ON_FOR_MS = 60_000;
/** An erase at its worst, and the answer to it. */
const SETTLE_MS = 5_000;

/** `entries` in the order of their times. Gives the board's packets and noise. */
export async function replayToBoard(
  entries: readonly Entry[],
  profile: ProfileName,
  options: Pick<BoardOptions, 'faults' | 'seed' | 'batteryMv'> = {},
): Promise<readonly PacketEntry[]> {
  const clock = createVirtualClock(entries[0]?.atMs ?? 0);
  const heard: PacketEntry[] = [];
  const hear =
    (mark: 'received' | 'garbage' | 'truncated') =>
    (bytes: Uint8Array): number =>
      heard.push({ atMs: clock.now(), mark, bytes });
  const receiver = createReceiver({
    clock,
    family: () => FAMILIES[profile],
    report: (_, bytes) => hear('received')(bytes),
    noise: (reason, bytes) => hear(reason)(bytes),
  });
  const board = createBoard({
    ...{ onForMs: ON_FOR_MS, ...options, clock, profile },
    send: (bytes) => receiver.push(bytes, false),
  });

  for (const entry of entries) {
    await clock.advance(entry.atMs - clock.now());
    if (entry.mark === 'sent') board.receive(entry.bytes);
    if (entry.mark !== 'link') continue;
    if (entry.happening === 'lost') board.unplug();
    if (entry.happening === 'opened') board.plugIn();
  }
  await clock.advance(SETTLE_MS);
  board.powerOff();
  return heard;
}
