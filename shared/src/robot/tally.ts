// How far the groups of one download have come together, and how long the rest takes. Knows sizes and time; no packet. The
// gateway counts alike (backend/servodeck/robot/board/download.py).

import type { Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import type { DownloadProgress } from './transport.ts';

export type Tally = (groupsStored: number, framesOfNext: number) => Omit<DownloadProgress, 'slots'>;

const sum = (sizes: readonly number[]): number => sizes.reduce((total, size) => total + size, 0);

/**
 * `sizes`: bytes of each frame of each group. Told that no frame of the next group is stored, its download begins, or begins
 * again. The time left is at least the wire's; what frames really took includes the flash.
 */
export function createTally(clock: Clock, sizes: readonly (readonly number[])[]): Tally {
  const frameCount = sizes.flat().length;
  const bytesTotal = sum(sizes.flat());
  let begunMs = clock.now();
  let msPerByte = 0;

  return (groupsStored, framesOfNext) => {
    const whole = sizes.slice(0, groupsStored).flat();
    const nextSent = sum(sizes[groupsStored]?.slice(0, framesOfNext) ?? []);
    if (framesOfNext === 0) begunMs = clock.now();
    else msPerByte = (clock.now() - begunMs) / nextSent;
    const bytesSent = sum(whole) + nextSent;
    const bytesLeft = bytesTotal - bytesSent;
    return {
      ...{ groupsStored, framesStored: whole.length + framesOfNext, frameCount, bytesSent, bytesTotal },
      remainingMs: Math.max(wireMs(bytesLeft), msPerByte * bytesLeft),
    };
  };
}
