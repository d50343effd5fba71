// Words about whose turn it is to drive a shared robot.

import { counted, formatMinutes, formatWhole } from './numbers.ts';

/** The gateway's name for whoever sits at its own computer. */
export const named = (name: string): string => (name === 'This computer' ? 'Another window' : name);
const begunBy = (name: string): string => (name === 'This computer' ? 'another window' : name);

const secondsLeft = (ms: number): string => `${formatWhole(Math.max(0, Math.ceil(ms / 1000)))} s`;

export const leaseWords = {
  label: 'Who drives',
  drives: 'You drive',
  others: (count: number): string => `${counted(count, 'other looks', 'others look')} on`,
  driver: (name: string): string => `${named(name)} drives`,
  nobody: 'Nobody drives',
  nobodyMore: 'Move anything to begin',
  watching: 'You look on',
  asked: (name: string): string => `${named(name)} was asked`,
  asker: (name: string): string => `${named(name)} asks to drive`,
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
  goesOn: (slot: number, by: string): string => `Slot ${formatWhole(slot)} goes on without ${begunBy(by)}`,
  goesOnFor: (ms: number): string => `${formatMinutes(ms)} at most; whoever drives next ends it`,
  goesOnLabel: 'Goes on alone',
  keep: 'Not without me',
  keepHint: 'It is stopped again when this page closes or is not heard',
  handOver: 'Hand over to …',
  handOverTo: (name: string): string => `Hand over to ${named(name)}`,
  given: (name: string): string => `${named(name)} handed the robot to you`,
  releaseHint: 'Somebody else may drive then. What moves is stopped first.',
};
