// Words about what feeds the robot: its volts, what they mean, what is to happen when they are low.

import type { Level } from '#shared/actions/battery/batteryGauge.ts';
import { formatAge, formatSeconds, formatVolts } from './numbers.ts';

export const batteryWords = {
  title: 'Battery',
  measured: 'Battery voltage, as the board measured it last',
  noVolts: '– V',
  above: (volts: string): string => `> ${volts}`,
  /** Of volts that are shown though the board no longer answers. */
  noNewer: 'none since',
  age: (ms: number): string => formatAge(ms),
  level: {
    pack: { good: 'Good', warning: 'Low', danger: 'Charge now' },
    adapter: { good: 'Good', warning: 'Low', danger: 'Too low' },
  } satisfies Record<string, Record<Level, string>>,
  volts: (millivolts: number): string => formatVolts(millivolts),

  warned: (volts: string): string => `The battery is low: ${volts} at rest.`,
  alarmed: (volts: string): string => `The battery is at its alarm: ${volts} at rest. Charge it now.`,
  alarmedRefusing: (volts: string): string =>
    `The battery is at its alarm: ${volts} at rest. New runs are refused; charge it now.`,
  goingToRest: (ms: number): string =>
    `In ${formatSeconds(ms)} the robot moves slowly to rest, because its battery is low. Stop keeps it where it is.`,
  rested: (volts: string): string =>
    `The robot was stopped, because its battery is low: ${volts} at rest. Charge it now.`,
  runRefused: (volts: string): string => `Not started: the battery is at its alarm, ${volts} at rest.`,
  anyway: 'Start anyway',

  tab: (volts: string, product: string): string => `Low battery, ${volts} – ${product}`,
};
