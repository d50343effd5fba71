// What the board has sent and the host has not got yet: late bytes hold up all behind them, as on any line. Knows bytes
// and times.

import type { Source } from './agenda.ts';

export interface Outbox extends Source {
  /** The byte reaches the host `lateMs` from now, or when those before it have. */
  readonly put: (byte: number, lateMs: number) => void;
  /** What is on its way gets lost. */
  readonly drop: () => void;
  /** What has reached the host since the last call. */
  readonly take: () => Uint8Array;
}

const NOTHING = new Uint8Array(0);

export function createOutbox(now: () => number): Outbox {
  let onTheWay: { readonly atMs: number; readonly byte: number }[] = [];
  let arrived: number[] = [];

  function put(byte: number, lateMs: number): void {
    if (lateMs === 0 && onTheWay.length === 0) arrived.push(byte);
    else onTheWay.push({ atMs: Math.max(now() + lateMs, onTheWay.at(-1)?.atMs ?? 0), byte });
  }

  function take(): Uint8Array {
    if (arrived.length === 0) return NOTHING;
    const bytes = Uint8Array.from(arrived);
    arrived = [];
    return bytes;
  }

  function fire(): void {
    arrived.push(...onTheWay.filter(({ atMs }) => atMs <= now()).map(({ byte }) => byte));
    onTheWay = onTheWay.filter(({ atMs }) => atMs > now());
  }

  return { put, take, drop: () => void (onTheWay = []), dueMs: () => onTheWay[0]?.atMs ?? Infinity, fire };
}
