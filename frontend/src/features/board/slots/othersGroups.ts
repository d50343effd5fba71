// What others stored in the slots of the board at hand, looked up in the library: a version that it holds is known as one's own is.
// Writes nothing to the library and tells nobody; what is not found stays what the link says of it.

import { groupFromText } from '#shared/group/group.ts';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { recordOf } from '#shared/group/slotBook.ts';
import type { StoredGroup } from '#shared/robot/state.ts';
import type { Device } from '../../../robot/device.ts';
import type { CompiledStore } from '../compile/compiled.ts';
import type { Library } from '../../library/library.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import type { Slots } from './slots.ts';

export interface OthersGroupsOptions {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly slots: Slots;
  readonly compiled: CompiledStore;
  readonly library: Pick<Library, 'store' | 'refresh'>;
  readonly documentStore: Promise<Pick<DocumentStore, 'read' | 'versions' | 'readVersion'>>;
}

export function findOthersGroups(options: OthersGroupsOptions): void {
  const { device, robots, slots, compiled, library } = options;
  let isLooking = false;
  let isAskedAgain = false;
  /** Documents that were not in the list when it was read for them. */
  const listedFor = new Set<string>();

  function unfound(): readonly (readonly [slot: number, stored: StoredGroup])[] {
    const { link, slotVersions } = device.store.getState().snapshot;
    if (link.status !== 'ready') return [];
    const { book } = slots.store.getState();
    return Object.entries(slotVersions ?? {}).flatMap(([key, stored]) =>
      stored === undefined || recordOf(book, Number(key)) !== undefined
        ? []
        : [[Number(key), stored] as const],
    );
  }

  async function look(): Promise<void> {
    isAskedAgain = isLooking;
    if (isLooking) return;
    isLooking = true;
    for (const [slot, stored] of unfound()) await lookFor(slot, stored).catch(() => undefined);
    isLooking = false;
    if (isAskedAgain) await look();
  }

  async function lookFor(slot: number, { documentId, version, name, by, atMs }: StoredGroup): Promise<void> {
    if (documentId === null || !isListed(documentId)) return;
    for await (const text of textsOf(documentId)) {
      const read = groupFromText(text);
      if ('problem' in read) continue;
      const on = { family: device.store.getState().family, robot: robots.current().robot };
      const { frames, fingerprint } = compiled.of(read.value, on);
      if (fingerprint !== version) continue;
      slots.noteOthers({ slot, name, documentId, frames, fingerprint, storedAtMs: atMs ?? 0, by });
      return;
    }
  }

  /** One that is new is on its way to the library: the list is read once more for it. */
  function isListed(documentId: string): boolean {
    if (library.store.getState().documents.some(({ id }) => id === documentId)) return true;
    if (!listedFor.has(documentId)) void library.refresh();
    listedFor.add(documentId);
    return false;
  }

  /** As it is now, then its named versions from the newest on. */
  async function* textsOf(id: string): AsyncGenerator<string> {
    const documentStore = await options.documentStore;
    yield (await documentStore.read(id)).text;
    for (const version of (await documentStore.versions(id)).toReversed())
      yield await documentStore.readVersion(id, version.id);
  }

  device.store.subscribe(({ snapshot: { link, slotVersions } }, { snapshot: before }) => {
    if (slotVersions !== before.slotVersions || link.status !== before.link.status) void look();
  });
  // Whoever stored it may hand it to the library later.
  library.store.subscribe(({ documents }, before) => {
    if (documents !== before.documents) void look();
  });
  robots.store.subscribe(() => void look());
}
