// A board on a bench for tests: virtual time, bytes as hex text, everything it sends recorded with its time. Knows the board's
// public face only.

import { createBoard, type Board, type BoardOptions } from '../simulator/board.ts';
import type { BusLogEntry } from '../simulator/line.ts';
import { uint16 } from '../simulator/groupStore.ts';
import { createVirtualClock, type VirtualClock } from './virtualClock.ts';

// A board on a bench for tests: virtual time, bytes as hex text, everything it sends recorded with its time.

export interface BoardUnderTest {
  readonly clock: VirtualClock;
  readonly board: Board;
  readonly log: readonly BusLogEntry[];
  /** Starts to send; the bytes take their time. */
  readonly send: (hex: string) => void;
  /** Sends and waits `ms`, 100 where not given: longer than any packet, shorter than an erase of a group. */
  readonly exchange: (hex: string, ms?: number) => Promise<void>;
  /** All the board sent so far, as hex text, and forgets it. */
  readonly takeReplies: () => string;
  readonly pulses: (...servos: readonly number[]) => number[];
}

const USUAL_WAIT_MS = 100;

export function bytesOf(hex: string): Uint8Array {
  return Uint8Array.from(hex.match(/[0-9A-F]{2}/gi) ?? [], (pair) => Number.parseInt(pair, 16));
}

export function hexOf(bytes: Iterable<number>): string {
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0').toUpperCase()).join(' ');
}

export function packet(command: number, params: readonly number[]): string {
  return hexOf([0x55, 0x55, params.length + 2, command, ...params]);
}

type Targets = readonly (readonly [servo: number, position: number])[];

function entries(targets: Targets): number[] {
  return targets.flatMap(([servo, position]) => [servo, ...uint16(position)]);
}

export const STOP = packet(7, []);
export const ERASE = packet(8, [0]);
export const READ_BATTERY = packet(15, []);
export const RUN_ACK = packet(6, []);
export const ERASE_ACK = packet(8, []);
export const DOWNLOAD_ACK = packet(25, []);
/** The board's word for "a group ended by itself" is the same packet as the host's stop. */
export const GROUP_ENDED = packet(7, []);

export function move(durationMs: number, ...targets: Targets): string {
  return packet(3, [targets.length, ...uint16(durationMs), ...entries(targets)]);
}

export function run(slot: number, times: number): string {
  return packet(6, [slot, ...uint16(times)]);
}

export function download(
  slot: number,
  frameCount: number,
  frameIndex: number,
  durationMs: number,
  ...targets: Targets
): string {
  return packet(25, [
    slot,
    frameCount,
    frameIndex,
    targets.length,
    ...uint16(durationMs),
    ...entries(targets),
  ]);
}

export function createBoardUnderTest(options: Partial<BoardOptions> = {}): BoardUnderTest {
  const clock = createVirtualClock();
  const log: BusLogEntry[] = [];
  let replies: number[] = [];
  const board = createBoard({
    clock,
    send: (bytes) => replies.push(...bytes),
    onByte: (entry) => log.push(entry),
    ...options,
  });

  function send(hex: string): void {
    board.receive(bytesOf(hex));
  }

  async function exchange(hex: string, ms = USUAL_WAIT_MS): Promise<void> {
    send(hex);
    await clock.advance(ms);
  }

  function takeReplies(): string {
    const taken = hexOf(replies);
    replies = [];
    return taken;
  }

  return { clock, board, log, send, exchange, takeReplies, pulses: (...servos) => servos.map(board.pulse) };
}
