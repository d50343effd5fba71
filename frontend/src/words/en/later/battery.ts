// Words about what feeds the robot: its volts, what they mean, what is to happen when they are low.

import type { BatteryKind, BatteryPolicy } from '#shared/actions/robot/robot.ts';
import { counted, formatTick, formatTimeOfDay, formatWhole } from '../numbers.ts';
import { batteryWords } from '../battery.ts';

export const wholeBatteryWords = {
  ...batteryWords,
  gauge: 'Measured battery voltage',
  estimated: 'What is left, estimated from the volts at rest',
  unread: 'Not read yet',
  zero: 'The board reads 0 V',
  zeroHint: 'It has measured nothing yet, or cannot see the battery. Nothing is judged by it.',
  saturated: 'More than it can measure',
  saturatedHint: 'The battery has that or more. Nothing is judged by it.',
  moving: 'Read while it moved',
  silent: 'This board cannot tell',
  absentHint: 'It has no command for that. Watch the battery itself.',
  silentHint: 'Three questions stayed unanswered. Refresh asks again.',
  refresh: 'Refresh',
  percent: (share: number): string => `≈ ${formatWhole(Math.round(share))} %`,

  kind: { adapter: 'Adapter', '2s': '2S pack', '3s': '3S pack' } satisfies Record<BatteryKind, string>,
  kindField: 'What feeds the robot',
  kindHint: {
    adapter: 'A mains adapter or USB. Nothing runs out, so there is no percentage.',
    '2s': 'Two Li-ion or LiPo cells, 7.4 V, full at 8.4 V.',
    '3s': 'Three Li-ion or LiPo cells, 11.1 V, full at 12.6 V.',
  } satisfies Record<BatteryKind, string>,

  settings: 'Battery settings',
  settingsOf: (robot: string): string => `Battery of ${robot}`,
  thresholds: 'Volts at rest',
  warnField: 'Warn at, in millivolts',
  alarmField: 'Alarm at, in millivolts',
  warnLabel: 'Warn at',
  alarmLabel: 'Alarm at',
  millivolts: 'mV',
  outOfRange: (min: number, max: number): string =>
    `A threshold is ${formatWhole(min)} to ${formatWhole(max)} mV.`,
  usual: 'Usual thresholds',
  policyField: 'At the alarm',
  policy: { tell: 'Tell me', refuse: 'Refuse new runs', rest: 'Go to rest and stop' } satisfies Record<
    BatteryPolicy,
    string
  >,
  policyHint: {
    tell: 'A message, nothing else. The robot goes on.',
    refuse: 'A message, and nothing new is run or played unless you say so once more.',
    rest: 'New runs are refused. When nothing runs, servos moved in this visit go slowly to the rest pose, home where none is marked, and the robot is stopped.',
  } satisfies Record<BatteryPolicy, string>,
  steps: {
    kind: 'what feeds the robot',
    thresholds: 'battery thresholds',
    policy: 'what a low battery does',
  },
  plot: (lowest: string, highest: string, now: string, runs: number): string =>
    `Volts measured in this visit: lowest ${lowest}, highest ${highest}, now ${now}; ${counted(runs, 'run')}`,
  noPlot: 'Volts measured in this visit: none yet',
  timeOfDay: formatTimeOfDay,
  tick: formatTick,
};
