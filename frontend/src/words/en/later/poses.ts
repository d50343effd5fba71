// Words about poses: capturing, changing and going to them.

import { formatMs, formatPercent, formatWhole } from '../numbers.ts';
import { poseWords } from '../poses.ts';

export const wholePoseWords = {
  ...poseWords,
  title: 'Poses',
  list: 'Poses',
  empty: 'No poses yet',
  emptyHint: 'Pose the robot with the sliders, then capture the pose and give it a name.',
  homeHint: 'Every servo to its home',
  restHint: (name: string): string => `Where the robot rests: ${name}`,
  go: (name: string, durationMs: number): string => `Go to ${name}, in ${formatMs(durationMs)}`,
  time: 'Time to reach a pose in milliseconds',
  timeLabel: 'In',
  copyOf: (name: string): string => `${name}, copy`,
  name: (name: string): string => `Name of ${name}`,
  about: (name: string, servoCount: number, all: number): string =>
    servoCount === all ? name : `${name}, ${formatWhole(servoCount)} of ${formatWhole(all)} servos`,
  applied: 'Went here last',
  resting: 'Rest',

  tools: 'Change the selected pose',
  select: 'Select a pose to change it.',
  update: 'Update pose',
  mirror: 'Mirror sides',
  mirrorHint: 'Left does what right does; a servo without a partner stays',
  flip: 'Flip',
  flipHint: 'Each servo as far from its home, the other way',
  held: (names: readonly string[]): string => `At its limit now, it cannot turn as far: ${names.join(', ')}.`,
  makeRest: 'Use as rest pose',
  earlier: 'Move pose earlier',
  later: 'Move pose later',
  duplicate: 'Duplicate pose',
  delete: 'Delete pose',
  add: 'Add to group',
  addHint: 'A frame of the open action group, behind the selected one or at the end',
  added: (name: string): string => `${name} is a frame of the action group now.`,
  openGroup: 'Show it',
  button: 'Make a button',
  buttonMade: (name: string): string => `${name} is a button now, under Buttons.`,
  moved: (from: number, to: number): string => `Pose ${formatWhole(from)} is now pose ${formatWhole(to)}`,

  servos: 'Servos',
  servosHint: 'A servo that is left out stays where it is.',
  servosOf: (count: number, all: number): string =>
    `Servos of this pose: ${formatWhole(count)} of ${formatWhole(all)}`,

  blend: 'Blend',
  blendWith: 'Blend with',
  blendNone: 'Another pose',
  blendShare: (name: string): string => `Share of ${name}`,
  share: (share: number): string => formatPercent(share),
  blendGo: 'Go to blend',
  blendKeep: 'Keep as pose',
  blendName: (one: string, other: string, share: number): string =>
    `${one} to ${other}, ${formatPercent(share)}`,
  blendNothing: 'The two poses have no servo in common.',

  fileName: (robot: string): string => `${robot} poses`,
  import: 'Import poses',
  export: 'Export poses',
  unreadableFile: 'The file could not be read.',
};
