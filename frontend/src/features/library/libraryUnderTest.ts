// Pages at one document store in virtual time, for tests. Each has its own state; `texts` is its browser's storage.

import type { DocumentStore } from '#shared/files/documentStore.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import type { VirtualClock } from '#shared/testing/virtualClock.ts';
import { createDocument } from '../groupDocument.ts';
import { createNotices } from '../../state/notices.ts';
import { createRobots } from '../profiles/robots.ts';
import { createView } from '../view.ts';
import { createLibrary } from './library.ts';
import { createLibraryFiles } from './libraryFiles.ts';

export const EPOCH_MS = 1_790_000_000_000;

/** The document store is known at once, or some time later. */
export function createVisit(
  documentStore: DocumentStore | Promise<DocumentStore>,
  clock: VirtualClock,
  texts = new Map<string, string>(),
) {
  /** Keys that the browser's storage refuses. */
  const full = new Set<string>();
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem(key: string, text: string): void {
      if (full.has(key)) throw new DOMException('full', 'QuotaExceededError');
      texts.set(key, text);
    },
  };
  const notices = createNotices(clock);
  const document = createDocument(storage, notices, clock);
  const view = createView({ browser: storage, tab: storage });
  const robots = createRobots(storage, notices);
  const begun = createLibrary({
    ...{ documentStore: Promise.resolve(documentStore), document, storage, notices, robots, view, clock },
    epochMs: () => EPOCH_MS,
    newId: nextId,
  });
  const library = { ...begun, ...createLibraryFiles(begun.forFiles) };
  const names = () =>
    library.store
      .getState()
      .documents.filter(({ isRemoved }) => !isRemoved)
      .map(({ facts }) => facts.name)
      .sort();
  return {
    ...{ texts, full, document, library, names, view, notices },
    noticeTexts: () => notices.store.getState().map(({ text }) => text),
    act: () => notices.store.getState().at(-1)?.action?.act(),
    group: () => document.store.getState().present,
    openId: () => library.store.getState().openId,
    capture: (position: number) =>
      document.edit(
        () => 'capture',
        (group) =>
          insertFrame(group, group.frames.length, { durationMs: 500, targets: [{ servo: 1, position }] }),
      ),
    /** Long enough for a change to be saved, or tried again. */
    later: () => clock.advance(5800),
    /** The browser reports that the page closes. */
    leave: document.flush,
  };
}

let ids = 0;
const nextId = (): string => `id-${++ids}`;
