// Refuses new runs and plays while the battery is at its alarm, where the robot's document says so. Twin of
// backend/servodeck/robot/battery_guard.py; the rule itself is batteryRule.ts.

import type { Clock } from '../clock.ts';
import type { Family } from '../codec/families.ts';
import { verdict, type RunLimit } from './batteryRule.ts';
import { LinkError } from './linkError.ts';
import type { SessionStore } from './store.ts';

export interface BatteryGuard {
  /** The board has told its voltage. */
  heard(batteryMv: number): void;
  /** What is known is not enough, and an answer may help. */
  mustAsk(): boolean;
  /** At rest only: a question disturbs what runs, and a load bends the answer. */
  mayAsk(): boolean;
  /** Resolves also where no answer comes. */
  ask(): Promise<void>;
  /** Throws `batteryLow`. Tells listeners where something runs although the battery is not known. */
  judge(): void;
}

export interface BatteryGuardOptions {
  readonly family: Family;
  readonly clock: Clock;
  readonly store: SessionStore;
  /** New runs are refused at or below; null: never. */
  alarmMv(): number | null;
  isAtRest(): boolean;
  readBattery(): Promise<number>;
}

export function createBatteryGuard(options: BatteryGuardOptions): BatteryGuard {
  const { family, clock, store, alarmMv, isAtRest, readBattery } = options;
  /** The newest reading while nothing moved: under load the voltage sags. */
  let rested: { readonly batteryMv: number; readonly atMs: number } | null = null;

  function limit(): RunLimit | null {
    const alarm = alarmMv();
    return alarm === null ? null : { alarmMv: alarm, ceilingMv: family.batteryCeilingMv };
  }

  const found = () =>
    verdict(limit(), rested?.batteryMv ?? null, rested === null ? 0 : clock.now() - rested.atMs);

  const mustAsk = (): boolean =>
    found() === 'unknown' && family.answers.includes('readBattery') && store.state.battery.kind !== 'silent';

  return {
    heard(batteryMv) {
      if (isAtRest()) rested = { batteryMv, atMs: clock.now() };
    },
    mustAsk,
    mayAsk: isAtRest,
    async ask() {
      if (mustAsk() && isAtRest()) await readBattery().catch(() => undefined);
    },
    judge() {
      const verdictNow = found();
      if (verdictNow === 'low')
        throw new LinkError('batteryLow', 'the battery is at its alarm: new runs are refused');
      if (verdictNow === 'unknown') store.emit('batteryUnknown', undefined);
    },
  };
}
