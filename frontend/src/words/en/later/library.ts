// Words about the library: where action groups are kept, found again and brought back.

import type { LibraryErrorCode } from '#shared/actions/library/keeper.ts';
import type { TextFlaw } from '#shared/actions/versionedText.ts';
import { FLAWS } from '../flaws.ts';
import { counted, formatLongAge, formatNames, formatSeconds, formatWhen } from '../numbers.ts';
import { libraryProblem, libraryWords } from '../library.ts';

const groups = (count: number): string => counted(count, 'group');
const frames = (count: number): string => counted(count, 'frame');

export const wholeLibraryWords = {
  ...libraryWords,
  button: 'Library',
  list: 'Action groups',
  place: {
    gateway: 'Kept by the gateway, for every browser at it. Each change is kept by itself.',
    browser: 'Kept in this browser. Each change is kept by itself; export it now and then.',
  },
  looking:
    'Waiting for the gateway’s word on where the library is. Until then each change is kept in this browser.',
  waiting: 'Not all changes are in the library yet.',
  empty: 'No groups in the library yet',
  emptyHint:
    'Close this and capture a frame: the group goes into the library by itself, with every change. Or import a file.',
  nothingFound: 'No group is like that.',

  search: 'Find a group',
  searchHint: 'Name, robot or tag',
  sort: 'Sort by',
  sorts: { updated: 'Last changed', name: 'Name', duration: 'Length' },
  tag: 'Tag',
  everyTag: 'Every tag',
  showRemoved: 'Deleted',

  create: 'New group',
  import: 'Import',
  export: 'Export',
  fileName: 'servodeck library',

  open: (name: string): string => `Open ${name}`,
  isOpen: 'Open now',
  about: (count: number, durationMs: number): string => `${frames(count)}, ${formatSeconds(durationMs)}`,
  age: (ms: number): string => formatLongAge(ms),
  more: (name: string): string => `More about ${name}`,
  name: (name: string): string => `Name of ${name}`,
  tags: (name: string): string => `Tags of ${name}`,
  tagsLabel: 'Tags',
  tagsHint: 'Separated by commas',
  duplicate: 'Duplicate',
  remove: 'Delete',
  restore: 'Bring back',

  versions: 'Versions',
  versionName: 'Name of the version',
  versionHint: 'For example: before the show',
  keepVersion: 'Keep version',
  noVersions: 'A version stays as it is while you go on changing the group.',
  restoreVersion: (name: string): string => `Go back to ${name}`,
  goBack: 'Go back to it',
  nameOfVersion: (name: string): string => `Name of version ${name}`,
  removeVersion: (name: string): string => `Delete version ${name}`,
  at: (epochMs: number): string => formatWhen(epochMs),
  unreadableFile: 'The file could not be read.',

  notImported: ({ code, at }: TextFlaw): string => `Nothing was taken from the file. ${FLAWS[code](at)}`,
  importWaits: 'The library is waited for. What is in the file comes in as soon as it answers.',
  importFailed: (code: LibraryErrorCode, detail: string): string =>
    `${libraryProblem(code, detail)} Nothing was taken from the file; import it again then.`,
  imported: (added: number, changed: number, same: number): string =>
    [
      `${groups(added)} added.`,
      changed === 0 ? '' : ` ${groups(changed)} differ from yours and stand beside them.`,
      same === 0 ? '' : ` ${groups(same)} were here already.`,
    ].join(''),
  exported: (count: number): string => `${groups(count)} exported.`,
  notExported: (names: readonly string[]): string =>
    `Not in the file, because it cannot be read: ${formatNames(names)}.`,
  versionOf: (name: string, version: string): string => `version ${version} of ${name}`,
  versionsOf: (name: string): string => `the versions of ${name}`,
  standsFor: (name: string, version: string): string => `${name} (its version ${version} stands for it)`,
};
