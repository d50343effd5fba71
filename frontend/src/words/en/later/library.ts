// Words about the library: where action groups are kept, found again and brought back.

import { counted, formatLongAge, formatSeconds, formatWhen } from '../numbers.ts';
import { libraryWords } from '../library.ts';

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
};
