// A board's slots as a gateway shares them, for tests: stores at once what is seen as it is, and others may store there too.

import { fingerprintOf } from '#shared/group/fingerprint.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type {
  SharedDownload,
  SharedSlots,
  SlotGroup,
  SlotVersions,
  StoredGroup,
} from '#shared/robot/transport.ts';

export function createSharedSlots(before: SlotVersions = {}) {
  let versions = before;
  let download: SharedDownload | null = null;
  let changed = (): void => undefined;
  const asked: SlotGroup[] = [];

  function store(groups: readonly SlotGroup[]): Promise<void> {
    asked.push(...groups);
    if (groups.some(({ slot, replaces }) => replaces !== (versions[slot]?.version ?? '')))
      return Promise.reject(new LinkError('slotChanged', 'something else is there'));
    versions = { ...versions, ...Object.fromEntries(groups.map(stored)) };
    download = {
      ...{ slots: groups.map(({ slot }) => slot), groupsStored: groups.length, isOver: true },
      ...{ framesStored: 0, frameCount: 0, bytesSent: 0, bytesTotal: 0, remainingMs: 0 },
    };
    changed();
    return Promise.resolve();
  }

  return {
    asked,
    versions: () => versions,
    /** Told at once, or only to who comes later. */
    othersStore(slot: number, stored: Partial<StoredGroup>, isReported = true) {
      versions = { ...versions, [slot]: storedGroup(stored) };
      if (isReported) changed();
    },
    othersErase() {
      versions = {};
      changed();
    },
    sharedSlots(next: () => void): SharedSlots {
      changed = next;
      return {
        broken: [],
        get versions() {
          return versions;
        },
        get download() {
          return download;
        },
        store,
        cancel: () => Promise.resolve(),
      };
    },
  };
}

export const storedGroup = (stored: Partial<StoredGroup>): StoredGroup => ({
  ...{ version: 'a version', name: '', documentId: null, by: '', atMs: null },
  ...stored,
});

const stored = ({ slot, frames, name = '', documentId = null }: SlotGroup) =>
  [slot, storedGroup({ version: fingerprintOf(frames), name, documentId })] as const;
