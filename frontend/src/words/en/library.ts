// Words about the library: where action groups are kept, found again and brought back.

import type { LibraryErrorCode } from '#shared/actions/library/keeper.ts';
import { formatNames } from './numbers.ts';

const PROBLEMS: Readonly<Record<LibraryErrorCode, string>> = {
  conflict: 'Somebody else has changed this group meanwhile. Try again.',
  notFound: 'This group is not in the library any more.',
  full: 'The disk of the library is full. What you write stays in this browser; free some space.',
  busy: 'Another program holds the library. What you write stays in this browser until it lets go.',
  tooLarge: 'This group is too large for the library. It stays in this browser alone; make it shorter.',
  unreachable: 'The gateway does not answer. What you write stays in this browser until it does.',
  unreadable: 'This version of Servodeck cannot read this group.',
  damaged: 'The disk has changed what the library keeps; nothing was deleted',
  failed: 'The library cannot be used',
};

export const libraryProblem = (code: LibraryErrorCode, detail: string): string => {
  if (code === 'damaged') return `${PROBLEMS.damaged}: ${detail}`;
  return code === 'failed' ? `${PROBLEMS.failed}: ${detail}.` : PROBLEMS[code];
};

export const libraryWords = {
  title: 'Library',
  notHeldHere:
    'This browser has no room for changes that wait for the library. Keep the page open until the library has them.',
  undo: 'Undo',
  copyOf: (name: string): string => `${name}, copy`,
  otherVersion: (name: string): string => `${name}, other version`,
  versionRenamed: (name: string, wanted: string): string => `Version ${name} is called ${wanted} now.`,
  versionRemoved: (name: string): string => `Version deleted: ${name}.`,
  versionKept: (name: string): string => `Version kept: ${name}.`,

  removed: (name: string): string => `Deleted: ${name}.`,
  recovered: (names: readonly string[]): string =>
    `Changes that were not in the library yet are there now: ${formatNames(names)}.`,
  conflict: (name: string, copy: string): string =>
    `${name} was changed elsewhere at the same time. Both are kept: the other one under its name, yours as “${copy}”.`,
  setAside: (file: string): string =>
    `The library’s file was damaged. It was set aside unharmed as ${file}, and a new library begun.`,
  changesLost:
    'The library’s journal was damaged: what was changed last before the gateway’s start may be missing.',
  problem: libraryProblem,

  steps: {
    rename: 'rename group',
    tags: 'change tags',
    elsewhere: 'changes made elsewhere',
    version: (name: string): string => `go back to ${name}`,
  },
};
