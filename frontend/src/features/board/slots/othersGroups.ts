// Looks up in the library the groups that other people downloaded to the board: with the right version found, their slots are known as
// well as this page's own. Reads only; slots that are not found stay as the link describes them.

import { compileSource } from '../compile/compileSource.ts';
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
  let isListedAgain = false;
  /** Documents that were missing when the library was listed for them. */
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
    isListedAgain = isLooking;
    if (isLooking) return;
    isLooking = true;
    for (const [slot, stored] of unfound()) await lookFor(slot, stored).catch(() => undefined);
    isLooking = false;
    if (isListedAgain) await look();
  }

  async function lookFor(slot: number, { documentId, version, name, by, atMs }: StoredGroup): Promise<void> {
    if (documentId === null || !isListed(documentId)) return;
    for await (const text of textsOf(documentId)) {
      const read = groupFromText(text);
      if ('problem' in read) continue;
      const on = { family: device.store.getState().family, robot: robots.current().robot };
      const { frames, fingerprint } = compiled.of(read.value, on, compileSource);
      if (fingerprint !== version) continue;
      slots.noteOthers({ slot, name, documentId, frames, fingerprint, storedAtMs: atMs ?? 0, by });
      return;
    }
  }

  /** A new document may still be on its way to the library: lists it once more. */
  function isListed(documentId: string): boolean {
    if (library.store.getState().documents.some(({ id }) => id === documentId)) return true;
    if (!listedFor.has(documentId)) void library.refresh();
    listedFor.add(documentId);
    return false;
  }

  /** Tries the current text, then the named versions, newest first. */
  async function* textsOf(id: string): AsyncGenerator<string> {
    const documentStore = await options.documentStore;
    yield (await documentStore.read(id)).text;
    for (const version of (await documentStore.versions(id)).toReversed())
      yield await documentStore.readVersion(id, version.id);
  }

  device.store.subscribe(({ snapshot: { link, slotVersions } }, { snapshot: before }) => {
    if (slotVersions !== before.slotVersions || link.status !== before.link.status) void look();
  });
  // The person who downloaded it may save it to the library later.
  library.store.subscribe(({ documents }, before) => {
    if (documents !== before.documents) void look();
  });
  robots.store.subscribe(() => void look());
  void look();
}
