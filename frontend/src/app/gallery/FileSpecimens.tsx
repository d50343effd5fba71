// What the dialog about files shows: groups of which one asks for its unit, one that does not fit, and broken files.

import type { Reading } from '#shared/files/reading.ts';
import { emptyGroup, type ActionGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { FilesContent } from '../../features/library/files/FilesDialog.tsx';
import { firstAnswers } from '../../features/library/files/answers.ts';
import {
  createOpenedFiles,
  type OpenedFile,
  type OpenedFiles,
} from '../../features/library/files/openedFiles.ts';
import type { Stores } from '../../features/stores.ts';
import type { Exhibit } from './exhibit.ts';
import { specimenStores } from './specimenStores.ts';

const READINGS: readonly (readonly [name: string, reading: Reading])[] = [
  ['No.10 wave.xml', { groups: [wave('wave', 1500, 10)], asksUnit: true, remarks: [] }],
  [
    'nod.xml',
    {
      groups: [wave('nod', 600, null)],
      asksUnit: false,
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
