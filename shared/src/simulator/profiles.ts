// The boards there are to simulate, as values: which firmware, with how many servos. Knows no behaviour: that is in the engines. Source:
// boards.md chapter 2.

import { createClosedEngine, type ClosedTraits } from './closedEngine.ts';
import type { CreateEngine } from './engine.ts';
import { createLearmEngine } from './learm/engine.ts';
import { BUS_LEARM, PWM_LEARM, type LearmTraits } from './learm/commands.ts';
import { createOpenEngine, type OpenBuild } from './openEngine.ts';
import type { ProfileName } from './profileNames.ts';

export interface BoardProfile {
  /** Servos on such a board where nothing else is said. */
  readonly usualServoCount: number;
  readonly maxServoCount: number;
  readonly createEngine: CreateEngine;
}

/** boards.md 3.2, column old: says nothing of runs and has no battery answer. */
const OLD_BUILD: OpenBuild = {
  ...{ acksRun: false, reportsEnd: false, chainedSlot: null, answersBattery: false },
  ...{ copiesToBus: true, padPollMs: 5.2, alwaysPolls: true },
};
/** boards.md 3.2, column leo. */
const NEW_BUILD: OpenBuild = {
  ...{ acksRun: true, reportsEnd: true, chainedSlot: 100, answersBattery: false },
  ...{ copiesToBus: true, padPollMs: 6.4, alwaysPolls: false },
};

function openFirmware(build: OpenBuild, maxServoCount: number): BoardProfile {
  return { usualServoCount: 6, maxServoCount, createEngine: (parts) => createOpenEngine(build, parts) };
}

/** 500..2500 µs; its pins carry no pulse until their first target (X4). */
const LSC: ClosedTraits = {
  position: { min: 500, max: 2500 },
  start: null,
  broadcast: null,
  talksToServos: false,
};
/** 0..1000 steps; bus servos know where they are and stay there at power-up (X4). */
const BUS: ClosedTraits = {
  position: { min: 0, max: 1000 },
  start: 400,
  broadcast: 254,
  talksToServos: true,
};

function closedFirmware(traits: ClosedTraits, usualServoCount: number, maxServoCount: number): BoardProfile {
  return { usualServoCount, maxServoCount, createEngine: (parts) => createClosedEngine(traits, parts) };
}

function leArm(traits: LearmTraits): BoardProfile {
  return {
    usualServoCount: 6,
    maxServoCount: 6,
    createEngine: (parts) => createLearmEngine(traits, parts),
  };
}

export const PROFILES: Readonly<Record<ProfileName, BoardProfile>> = {
  /** The ideal board of the protocol document: the open firmware that reports its battery, with any number of servos. */
  doc: openFirmware({ ...NEW_BUILD, answersBattery: true, copiesToBus: false }, 32),
  'openarm-old': openFirmware(OLD_BUILD, 6),
  'openarm-new': openFirmware(NEW_BUILD, 6),
  'lsc-6': closedFirmware(LSC, 6, 6),
  'lsc-16': closedFirmware(LSC, 16, 16),
  'lsc-24': closedFirmware(LSC, 24, 24),
  'lsc-32': closedFirmware(LSC, 32, 32),
  'bus-ctrl': closedFirmware(BUS, 6, 32),
  xarm: closedFirmware(BUS, 6, 6),
  'learm-esp32': leArm(PWM_LEARM),
  'learm-esp32-bus': leArm(BUS_LEARM),
};
