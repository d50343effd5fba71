// The bus log read as packets, each with the time it took on the wire: what really happened, whatever a client believes.
// Knows the log and the codec; not who sent what.

import type { Command } from '#shared/codec/commands.ts';
import { createDecoder } from '#shared/codec/decoder.ts';
import { parseCommand } from '#shared/codec/parse.ts';
import { COMMAND_SHAPES } from '#shared/codec/shapes.ts';
import type { BusLogEntry } from '#shared/simulator/line.ts';

export interface BusPacket {
  readonly command: Command;
  readonly byteCount: number;
  /** When its first byte had arrived at the board. */
  readonly firstByteMs: number;
  /** When its last byte had arrived: it has left the wire. */
  readonly endMs: number;
}

/** The packets that went into the board, oldest first. Noise is passed over. */
export function packetsInto(log: readonly BusLogEntry[]): readonly BusPacket[] {
  const into = log.filter(({ direction }) => direction === 'in');
  const packets: BusPacket[] = [];
  let from = 0;
  // A packet is believed only when its neighbour begins, so its times come from where its bytes stand in the log.
  const decoder = createDecoder((event) => {
    const first = into[from];
    from += event.bytes.length;
    const last = into[from - 1];
    const command = event.kind === 'packet' ? parseCommand(event.packet) : null;
    if (!command || !first || !last) return;
    packets.push({ command, byteCount: event.bytes.length, firstByteMs: first.atMs, endMs: last.atMs });
  }, COMMAND_SHAPES);
  decoder.push(Uint8Array.from(into, ({ byte }) => byte));
  decoder.idle();
  return packets;
}
