// Whether something new may begin to run, by the battery's last reading at rest. Pure. Twin of
// backend/servodeck/robot/board/battery_rule.py; both run protocol/vectors/batteryRule.json.

import timings from '../../protocol/timings.json' with { type: 'json' };

export type Verdict = 'runs' | 'low' | 'unknown';

/** New runs are refused at or below `alarmMv`. Above `ceilingMv` the board measures nothing (S60). */
export interface RunLimit {
  readonly alarmMv: number;
  readonly ceilingMv: number | null;
}

/** `batteryMv`: the last reading at rest, `ageMs` old; null where there was none. */
export function verdict(limit: RunLimit | null, batteryMv: number | null, ageMs: number): Verdict {
  if (limit === null) return 'runs';
  if (batteryMv === null || ageMs > timings.battery.judgedWithinMs || !isMeasured(batteryMv, limit))
    return 'unknown';
  return batteryMv <= limit.alarmMv ? 'low' : 'runs';
}

/** 0: the board has no sample yet (S59). */
function isMeasured(batteryMv: number, { ceilingMv }: RunLimit): boolean {
  return batteryMv > 0 && (ceilingMv === null || batteryMv <= ceilingMv);
}
