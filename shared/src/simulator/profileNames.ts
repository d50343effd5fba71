// Which boards there are to simulate, by name: all that a page knows of them before it simulates one.

const NAMES = [
  'doc',
  'openarm-old',
  'openarm-new',
  'lsc-6',
  'lsc-16',
  'lsc-24',
  'lsc-32',
  'bus-ctrl',
  'xarm',
  'learm-esp32',
  'learm-esp32-bus',
] as const;

export type ProfileName = (typeof NAMES)[number];

export const isProfileName = (text: string): text is ProfileName => NAMES.some((name) => name === text);
