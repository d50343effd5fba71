// Runs every vector of shared/protocol/vectors. The gateway's own codec runs the same files (backend/tests).

import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import type { Command } from './commands.ts';
import { createDecoder } from './decoder.ts';
import { encodeCommand, encodeReport, RangeRefusal } from './encode.ts';
import { family, type FamilyId } from './families.ts';
import { fromHex, toHex, type Packet } from './packet.ts';
import { parseCommand, parseReport } from './parse.ts';
import type { Report } from './reports.ts';
import { COMMAND_SHAPES, REPORT_SHAPES } from './shapes.ts';

interface CommandVector {
  readonly name: string;
  readonly family: FamilyId;
  readonly hex: string;
  readonly command: Command;
}

interface ReportVector {
  readonly name: string;
  readonly family: FamilyId;
  readonly hex: string;
  readonly report:
    | Exclude<Report, { kind: 'unknown' }>
    | { kind: 'unknown'; command: number; params: string };
}

interface RefusalVector {
  readonly name: string;
  readonly family: FamilyId;
  readonly command: Command;
  readonly field: string;
  readonly value: number | string;
  readonly min?: number;
  readonly max?: number;
  readonly allowed?: string;
  readonly servo?: number;
  readonly message: string;
}

type StreamEvent =
  | { readonly kind: 'packet'; readonly bytes: string }
  | { readonly kind: 'noise'; readonly reason: 'garbage' | 'truncated'; readonly bytes: string };

interface StreamVector {
  readonly name: string;
  readonly direction: 'report' | 'command';
  /** Hex, or `pause` or `idle` where the line falls silent. */
  readonly feed: readonly string[];
  readonly events: readonly StreamEvent[];
}

function load(name: string): unknown {
  return JSON.parse(readFileSync(new URL(`../../protocol/vectors/${name}.json`, import.meta.url), 'utf8'));
}

function packetOf(hex: string): Packet {
  const bytes = fromHex(hex);
  return { command: bytes[3]!, params: bytes.slice(4) };
}

/** What a decoder of that direction says to the feed. */
function decode({ direction, feed }: Pick<StreamVector, 'direction' | 'feed'>): StreamEvent[] {
  const events: StreamEvent[] = [];
  const decoder = createDecoder(
    (event) => {
      const bytes = toHex(event.bytes);
      events.push(
        event.kind === 'packet' ? { kind: 'packet', bytes } : { kind: 'noise', reason: event.reason, bytes },
      );
    },
    direction === 'report' ? REPORT_SHAPES : COMMAND_SHAPES,
  );
  for (const piece of feed) {
    if (piece === 'idle') decoder.idle();
    else if (piece === 'pause') decoder.pause();
    else decoder.push(fromHex(piece));
  }
  return events;
}

/** The same bytes and silences, with everything between two silences in one piece. */
function whole(feed: readonly string[]): string[] {
  return feed
    .join(' ')
    .split(/(idle|pause)/)
    .map((piece) => piece.trim())
    .filter((piece) => piece !== '');
}

function byteByByte(feed: readonly string[]): string[] {
  return feed.flatMap((piece) => piece.split(' '));
}

describe('command vectors', () => {
  test.each(load('commands') as readonly CommandVector[])('$name', ({ family: id, hex, command }) => {
    expect(toHex(encodeCommand(command, family(id)))).toBe(hex);
    expect(parseCommand(packetOf(hex))).toEqual(command);
    expect(decode({ direction: 'command', feed: [hex, 'idle'] })).toEqual([{ kind: 'packet', bytes: hex }]);
  });
});

describe('report vectors', () => {
  test.each(load('reports') as readonly ReportVector[])('$name', ({ family: id, hex, report }) => {
    const expected =
      report.kind === 'unknown' ? { ...report, params: fromHex(report.params) } : (report satisfies Report);
    expect(parseReport(packetOf(hex), family(id))).toEqual(expected);
    expect(toHex(encodeReport(expected))).toBe(hex);
    expect(decode({ direction: 'report', feed: [hex, 'idle'] })).toEqual([{ kind: 'packet', bytes: hex }]);
  });
});

describe('refusal vectors', () => {
  test.each(load('refusals') as readonly RefusalVector[])('$name', (vector) => {
    const { family: id, command, field, value, min, max, allowed, servo, message } = vector;
    const encode = (): Uint8Array => encodeCommand(command, family(id));
    expect(encode).toThrow(RangeRefusal);
    expect(encode).toThrow(expect.objectContaining({ field, value, min, max, allowed, servo, message }));
  });
});

describe('stream vectors', () => {
  const streams = load('streams') as readonly StreamVector[];

  test.each(streams)('$name', ({ direction, feed, events }) => {
    expect(decode({ direction, feed })).toEqual(events);
  });

  test.each(streams)('$name, in one piece', ({ direction, feed, events }) => {
    expect(decode({ direction, feed: whole(feed) })).toEqual(events);
  });

  test.each(streams)('$name, one byte at a time', ({ direction, feed, events }) => {
    expect(decode({ direction, feed: byteByByte(feed) })).toEqual(events);
  });

  test.each(streams)('$name, noise before', ({ direction, feed, events }) => {
    // 64 bytes: exactly one noise event, so what follows is as it was.
    const noise = toHex(Uint8Array.from({ length: 64 }, (_, i) => i));
    const expected = [{ kind: 'noise', reason: 'garbage', bytes: noise }, ...events];
    expect(decode({ direction, feed: [noise, ...feed] })).toEqual(expected);
  });
});
