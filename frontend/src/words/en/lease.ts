// Words about whose turn it is to drive a shared robot.

import { counted, formatWhole } from './numbers.ts';

/** The gateway's name for whoever sits at its own computer. */
const named = (name: string): string => (name === 'This computer' ? 'Another window' : name);

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
  passesIn: (ms: number): string => `Passes in ${formatWhole(Math.max(0, Math.ceil(ms / 1000)))} s`,
  request: 'Ask to drive',
  requestHint: 'Passes to you when the driver agrees or says nothing for five seconds',
  takeBack: 'Do not ask',
  take: 'Take over',
  takeHint: 'Without asking. What moves is stopped first.',
  allow: 'Allow',
  refuse: 'Refuse',
  release: 'Let go',
  releaseHint: 'Somebody else may drive then. What moves is stopped first.',
};
