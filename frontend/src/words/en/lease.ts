// Words about whose turn it is to drive a shared robot.

import { counted, formatMinutes, formatWhole } from './numbers.ts';

/** Whoever is called as `you` is another window of the same browser, or of the robot's computer. */
export const named = (name: string, you: string): string => (name === you ? 'Another window' : name);
const amid = (name: string, you: string): string =>
  name === you ? 'another window' : name.replace(/^A script on this computer$/, 'a script on this computer');

const secondsLeft = (ms: number): string => `${formatWhole(Math.max(0, Math.ceil(ms / 1000)))} s`;

export const leaseWords = {
  label: 'Who drives',
  drives: 'You drive',
  others: (count: number): string => `${counted(count, 'other looks', 'others look')} on`,
  driver: (name: string, you: string): string => `${named(name, you)} drives`,
  nobody: 'Nobody drives',
  nobodyMore: 'Move anything to begin',
  watching: 'You look on',
  asked: (name: string, you: string): string => `${named(name, you)} was asked`,
  asker: (name: string, you: string): string => `${named(name, you)} asks to drive`,
  theirsIn: (ms: number): string => `Theirs in ${secondsLeft(ms)} unless you refuse`,
  yoursIn: (ms: number): string => `Yours in ${secondsLeft(ms)} unless it is refused`,
  request: 'Ask to drive',
  requestHint: 'Passes to you when the driver agrees or says nothing for five seconds',
  takeBack: 'Do not ask',
  take: 'Take over',
  takeHint: 'Without asking. What moves is stopped first.',
  allow: 'Allow',
  refuse: 'Refuse',
  release: 'Let go',
  mayGoOn: (slot: number): string => `Slot ${formatWhole(slot)} may go on without you`,
  goesOn: (slot: number, by: string, you: string): string =>
    `Slot ${formatWhole(slot)} goes on without ${amid(by, you)}`,
  goesOnFor: (ms: number): string => `${formatMinutes(ms)} at most; whoever drives next ends it`,
  goesOnLabel: 'Goes on alone',
  keep: 'Not without me',
  keepHint: 'It is stopped again when this page closes or is not heard',
  handOver: 'Hand over to …',
  handOverTo: (name: string): string => `Hand over to ${name}`,
  given: (name: string, you: string): string => `${named(name, you)} handed the robot to you`,
  releaseHint: 'Somebody else may drive then. What moves is stopped first.',
};
