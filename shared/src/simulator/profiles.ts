// The boards there are to simulate, as values: which firmware, with how many servos. Knows their names, no behaviour: that
// is in the engines. Source: boards.md chapter 2.

import type { CreateEngine } from './engine.ts';
import { createOpenEngine, type OpenBuild } from './openEngine.ts';

export interface BoardProfile {
  /** Servos on such a board where nothing else is said. */
  readonly usualServoCount: number;
  readonly maxServoCount: number;
  readonly createEngine: CreateEngine;
}

/** boards.md 3.2, column old: says nothing of runs and has no battery answer. */
const OLD_BUILD: OpenBuild = { acksRun: false, reportsEnd: false, chainedSlot: null, answersBattery: false };
/** boards.md 3.2, column leo. */
const NEW_BUILD: OpenBuild = { acksRun: true, reportsEnd: true, chainedSlot: 100, answersBattery: false };

function openFirmware(build: OpenBuild, maxServoCount: number): BoardProfile {
  return { usualServoCount: 6, maxServoCount, createEngine: (parts) => createOpenEngine(build, parts) };
}

export const PROFILES = {
  /** The ideal board of the protocol document: the open firmware that tells its battery, with any number of servos. */
  doc: openFirmware({ ...NEW_BUILD, answersBattery: true }, 32),
  'openarm-old': openFirmware(OLD_BUILD, 6),
  'openarm-new': openFirmware(NEW_BUILD, 6),
} as const satisfies Readonly<Record<string, BoardProfile>>;

export type ProfileName = keyof typeof PROFILES;

export function isProfileName(text: string): text is ProfileName {
  return Object.hasOwn(PROFILES, text);
}
