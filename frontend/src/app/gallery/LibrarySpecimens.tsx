// The library in each of its states, fed by a library that lives as long as the page.

import type { ActionGroup } from '#shared/group/group.ts';
import { insertFrame, rename } from '#shared/group/groupEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { LibraryView } from '../../features/library/LibraryView.tsx';
import type { Stores } from '../../features/stores.ts';
import type { Exhibit } from './exhibit.ts';
import { specimenStores } from './specimenStores.ts';

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
        const robot = index === 1 ? 'A robot of somebody else' : robots.current().robot.name;
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
