// Notices battery answers that were not asked for here: then another program uses the same board, which neither a HID cable nor
// Bluetooth forbids. Knows the packets that passed; asks nothing. Its twin is UnaskedAnswers of robot/board/readings.py.

import type { Traffic } from '#shared/robot/state.ts';
import timings from '../../../shared/protocol/timings.json' with { type: 'json' };

const { unaskedAfterMs, unaskedLimit } = timings.battery;

export type UnaskedAnswers = (traffic: Traffic) => void;

/** For one link. `found` is called once. */
export function createUnaskedAnswers(found: () => void): UnaskedAnswers {
  let askedAtMs = -Infinity;
  let count = 0;

  return (traffic) => {
    if (traffic.direction === 'out') {
      if (traffic.command?.kind === 'readBattery') askedAtMs = traffic.atMs;
      return;
    }
    if (!('report' in traffic) || traffic.report.kind !== 'battery') return;
    if (traffic.atMs - askedAtMs <= unaskedAfterMs) return;
    count += 1;
    if (count === unaskedLimit) found();
  };
}
