// The library and the dialog for files in their states, with a document store in memory.

import { type ActionGroup, emptyGroup } from '#shared/group/group.ts';
import { insertFrame, rename } from '#shared/group/groupEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { LibraryView } from '../../features/library/LibraryView.tsx';
import type { Stores } from '../../features/stores.ts';
import { type Exhibit, specimenStores } from './exhibit.ts';
import type { Reading } from '#shared/files/reading.ts';
import { FilesContent } from '../../features/library/files/FilesDialog.tsx';
import { firstAnswers } from '../../features/library/files/answers.ts';
import {
  createOpenedFiles,
  type OpenedFile,
  type OpenedFiles,
} from '../../features/library/files/openedFiles.ts';

const GROUPS = ['Wave to the visitors at the door', 'Bow', 'Pick up the red cube and put it down', 'Dance'];
const TAGS = [['greeting', 'show'], [], ['work'], ['show']];

async function fill({ library, document, robots }: Stores): Promise<void> {
  for (const [index, name] of GROUPS.entries()) {
    library.create();
    document.edit(
      () => 'fill',
      (empty) => {
        const frames = Array.from({ length: 3 + 4 * index }, (_, frame) => ({
          durationMs: 400,
          targets: [1, 2, 3, 4, 5, 6].map((servo) => ({
            servo,
            position: Math.round(1500 + 700 * Math.sin(index * 1.7 + frame * 0.4 + servo)),
          })),
        }));
        const tagged = { ...rename(empty, name), tags: TAGS[index] ?? [] };
        const robot = index === 1 ? 'A robot of another person' : robots.current().robot.name;
        return frames.reduce<ActionGroup>((group, frame, at) => insertFrame(group, at, frame), {
          ...tagged,
          robot,
        });
      },
    );
    await library.refresh();
  }
  await library.keepVersion(library.store.getState().openId, 'Before the show');
}

const CONTENT = { isInDialog: true, content: <LibraryView onDone={() => undefined} /> } as const;

export const LIBRARY: readonly Exhibit[] = [
  { name: 'Library, empty', ...CONTENT },
  {
    name: 'Library',
    ...CONTENT,
    stores() {
      const stores = specimenStores(FAMILIES.doc);
      void fill(stores);
      return stores;
    },
  },
];

/** Files with a group without a unit, one that does not fit, and broken ones. */
const READINGS: readonly (readonly [name: string, reading: Reading])[] = [
  ['No.10 wave.xml', { groups: [wave('wave', 1500, 10)], isUnitMissing: true, remarks: [] }],
  [
    'nod.xml',
    {
      groups: [wave('nod', 600, null)],
      isUnitMissing: false,
      remarks: [{ code: 'servoTwice', place: { frame: 3 }, found: '2' }],
    },
  ],
  ['dance.rob', { problem: { code: 'encrypted', place: null, found: '' } }],
  ['walk.csv', { problem: { code: 'badPosition', place: { line: 7 }, found: '1500.5' } }],
];

function opened(): OpenedFiles {
  const files = createOpenedFiles({ read: () => new Promise(() => undefined), stop: () => undefined });
  const list = READINGS.map(([name, reading], id): OpenedFile => ({
    ...{ id, batch: 0, name, reading, answers: firstAnswers(reading) },
  }));
  files.store.setState({ list, reading: { done: 4, total: 9 } });
  return files;
}

export const FILES: readonly Exhibit[] = [
  {
    name: 'Files',
    isInDialog: true,
    content: <FilesContent files={opened()} onTake={() => undefined} onTakeAll={() => undefined} />,
    stores: prepared,
  },
];

function prepared(): Stores {
  const stores = specimenStores(FAMILIES.doc);
  stores.document.edit(
    () => 'open',
    () => wave('Wave', 1500, null),
  );
  return stores;
}

function wave(name: string, centre: number, slot: number | null): ActionGroup {
  const swings = Array.from({ length: 12 }, (_, index) => ({
    durationMs: 300,
    targets: Array.from({ length: index === 4 ? 3 : 6 }, (_, servo) => ({
      servo: servo + 1,
      position: Math.round(centre + 380 * Math.sin(index * 0.8) * Math.cos(servo)),
    })),
  }));
  return swings.reduce<ActionGroup>((group, frame, index) => insertFrame(group, index, frame), {
    ...emptyGroup(name, 'us'),
    slot,
  });
}
