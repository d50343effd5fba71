import { describe, expect, test } from 'vitest';
import { rename } from '#shared/group/groupEdits.ts';
import { groupFromText, groupToText, emptyGroup, GROUP_NAME_LENGTH } from '#shared/group/group.ts';
import { LibraryError, type DocumentStore } from '#shared/files/documentStore.ts';
import { libraryFromText, type BundledDocument } from '#shared/files/libraryText.ts';
import { createVirtualClock, type VirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryStore } from './memoryStore.ts';
import { libraryProblem } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { createVisit } from './libraryUnderTest.ts';

const called = (name: string) => (group: Parameters<typeof rename>[0]) => rename(group, name);

function createPlace(documentStore: DocumentStore = createMemoryStore()) {
  const clock = createVirtualClock();
  const visit = (texts?: Map<string, string>) => createVisit(documentStore, clock, texts);
  return { documentStore, clock, visit };
}

/** Goes away and comes back, as a gateway does. */
function unreliable(documentStore: DocumentStore) {
  const state = { isAway: false };
  const away = <T>(ask: () => Promise<T>): Promise<T> =>
    state.isAway ? Promise.reject(new LibraryError('unreachable', 'away')) : ask();
  const flaky: DocumentStore = {
    ...documentStore,
    list: () => away(documentStore.list),
    read: (id) => away(() => documentStore.read(id)),
    write: (id, writing) => away(() => documentStore.write(id, writing)),
  };
  return { flaky, state };
}

const textAt = async (documentStore: DocumentStore, id: string) => {
  const read = groupFromText((await documentStore.read(id)).text);
  return 'value' in read ? read.value : null;
};

describe('keeping', () => {
  test('what is captured is in the library after a pause, with what a list says of it', async () => {
    const { visit, clock, documentStore } = createPlace();
    const page = visit();
    await page.later();
    page.capture(1500);
    page.capture(1800);
    await clock.advance(515);
    expect((await documentStore.list()).documents).toEqual([]);
    await clock.advance(1);
    expect((await documentStore.list()).documents).toHaveLength(1);
    await page.library.refresh();
    const [listed] = page.library.store.getState().documents;
    expect(listed).toMatchObject({ id: page.openId(), revision: 1 });
    expect(listed!.facts).toMatchObject({
      frames: 2,
      durationMs: 1000,
      pose: [{ servo: 1, position: 1800 }],
    });
    expect(listed!.facts.robot).not.toBe('');
  });

  test('a list that says the same is the same list, and one changed group leaves the others as they are', async () => {
    const page = createPlace().visit();
    const listed = () => page.library.store.getState().documents;
    page.capture(1500);
    for (const name of ['Bow', 'Nod']) await page.library.add(emptyGroup(name, 'us'));
    await page.later();
    await page.library.refresh();
    const before = listed();
    await page.library.refresh();
    expect(listed()).toBe(before);
    page.capture(1600);
    await page.later();
    await page.library.refresh();
    const others = before.filter(({ id }) => id !== page.openId());
    expect(others).toHaveLength(2);
    for (const other of others) expect(listed()).toContain(other);
    expect(listed().find(({ id }) => id === page.openId())?.facts.frames).toBe(2);
  });

  test('a page that only looks writes nothing', async () => {
    const { visit, documentStore } = createPlace();
    const page = visit();
    await page.later();
    expect((await documentStore.list()).documents).toEqual([]);
  });

  test('the next visit shows the same document, and its changes go on from its revision', async () => {
    const { visit, documentStore } = createPlace();
    const first = visit();
    first.capture(1500);
    await first.later();
    const second = visit(first.texts);
    await second.later();
    second.capture(1600);
    await second.later();
    expect(second.openId()).toBe(first.openId());
    expect((await documentStore.list()).documents).toMatchObject([{ revision: 2 }]);
    expect(second.noticeTexts()).toEqual([]);
  });

  test('a group from before there was a library goes into it', async () => {
    const { visit } = createPlace();
    const before = { ...emptyGroup('Old', 'us'), nextId: 2 };
    const frame = { id: 1, durationMs: 1, targets: [], easing: 'linear', note: '', colour: null } as const;
    const text = groupToText({ ...before, frames: [frame] });
    const page = visit(new Map([['servodeck.group', text]]));
    await page.later();
    expect(page.names()).toEqual(['Old']);
  });

  test.each([
    ['the page went at once', (first: ReturnType<typeof createVisit>) => first.leave()],
    ['it crashed a moment later', (_: unknown, clock: VirtualClock) => clock.advance(16)],
  ])('what was not kept yet is kept at the next visit, and a notice says so: %s', async (_name, end) => {
    const { visit, clock } = createPlace();
    const first = visit();
    await clock.advance(0);
    first.document.edit(() => 'name', called('Wave'));
    first.capture(1500);
    expect(first.library.store.getState().isSaved).toBe(false);
    await end(first, clock);
    const second = visit(first.texts);
    await second.later();
    expect(second.names()).toEqual(['Wave']);
    expect(second.noticeTexts()).toEqual([
      words.library.recovered({ names: words.numbers.formatNames(['Wave']) }),
    ]);
    expect(second.group().frames).toHaveLength(1);
  });

  test('while the library is away everything waits here, is reported once, and is kept when it is back', async () => {
    const { flaky, state } = unreliable(createMemoryStore());
    const { visit } = createPlace(flaky);
    const page = visit();
    await page.later();
    state.isAway = true;
    page.capture(1500);
    await page.later();
    await page.later();
    expect(page.noticeTexts()).toEqual([libraryProblem('unreachable', '')]);
    expect(page.library.store.getState().isSaved).toBe(false);
    page.library.create();
    page.capture(1700);
    state.isAway = false;
    await page.later();
    await page.library.refresh();
    expect(page.names()).toHaveLength(2);
    expect(page.library.store.getState().isSaved).toBe(true);
    expect(page.noticeTexts()).toEqual([]);
  });

  test('what has no room here while the library is away is reported until either has it', async () => {
    const { flaky, state } = unreliable(createMemoryStore());
    const { visit } = createPlace(flaky);
    const page = visit();
    page.full.add('servodeck.unkept');
    page.capture(1500);
    await page.later();
    expect(page.noticeTexts(), 'the library has it').toEqual([]);
    state.isAway = true;
    page.capture(1600);
    await page.later();
    expect(page.noticeTexts()).toEqual([libraryProblem('unreachable', ''), words.library.notHeldHere]);
    page.full.clear();
    page.capture(1700);
    await page.later();
    expect(page.noticeTexts()).toEqual([libraryProblem('unreachable', '')]);
    page.full.add('servodeck.unkept');
    page.capture(1800);
    await page.later();
    expect(page.noticeTexts()).toContain(words.library.notHeldHere);
    state.isAway = false;
    await page.later();
    expect(page.noticeTexts()).toEqual([]);
  });

  test('until the place of the library is known everything waits here, and both sides of a conflict are kept', async () => {
    const documentStore = createMemoryStore();
    const { visit, clock } = createPlace(documentStore);
    const before = visit();
    before.document.edit(() => 'name', called('Wave'));
    await before.later();

    let answer: (found: DocumentStore) => void = () => undefined;
    const late = createVisit(new Promise((resolve) => (answer = resolve)), clock, before.texts);
    late.capture(1500);
    late.library.create();
    late.document.edit(() => 'name', called('Bow'));
    await late.later();
    expect(late.library.store.getState()).toMatchObject({ place: null, isSaved: false });
    const other = visit();
    await other.library.open(before.openId());
    other.capture(1900);
    await other.later();

    answer(documentStore);
    await late.later();
    expect(late.names()).toEqual(['Bow', 'Wave', 'Wave, other version']);
    expect(late.library.store.getState().isSaved).toBe(true);
    expect(late.noticeTexts()).toEqual([
      words.library.conflict({ name: 'Wave', copy: 'Wave, other version' }),
    ]);
  });

  test('a drag is one write, and none while it lasts', async () => {
    const { visit, documentStore } = createPlace();
    const page = visit();
    page.capture(1500);
    page.document.begin(() => 'drag');
    page.document.preview(called('Half way'));
    await page.later();
    expect((await textAt(documentStore, page.openId()))!.name).not.toBe('Half way');
    page.document.commit();
    await page.later();
    expect((await textAt(documentStore, page.openId()))!.name).toBe('Half way');
  });

  test('a group that is refused keeps no other waiting', async () => {
    const documentStore = createMemoryStore();
    const write: DocumentStore['write'] = (id, writing) =>
      writing.facts.name === 'Huge'
        ? Promise.reject(new LibraryError('tooLarge', 'too large'))
        : documentStore.write(id, writing);
    const { visit } = createPlace({ ...documentStore, write });
    const page = visit();
    page.document.edit(() => 'name', called('Huge'));
    page.library.create();
    page.document.edit(() => 'name', called('Small'));
    await page.later();
    expect((await documentStore.list()).documents.map(({ facts }) => facts.name)).toEqual(['Small']);
  });
});

describe('two pages at one library', () => {
  async function bothOpen() {
    const { visit, documentStore, clock } = createPlace();
    const one = visit();
    one.document.edit(() => 'name', called('Wave'));
    await one.later();
    const other = visit();
    await other.later();
    await other.library.open(one.openId());
    return { one, other, documentStore, clock };
  }

  test('changes at the same time are both kept, and the later one is reported', async () => {
    const { one, other, documentStore, clock } = await bothOpen();
    const id = one.openId();
    one.capture(1111);
    await clock.advance(100);
    other.capture(2222);
    await one.later();
    await one.library.refresh();
    const copy = words.library.otherVersion({ name: 'Wave' });
    expect(one.names()).toEqual(['Wave', copy]);
    expect((await textAt(documentStore, id))!.frames[0]!.targets[0]!.position).toBe(1111);
    expect((await textAt(documentStore, other.openId()))!.frames[0]!.targets[0]!.position).toBe(2222);
    expect(other.group().name).toBe(copy);
    expect(other.noticeTexts()).toEqual([words.library.conflict({ name: 'Wave', copy })]);
    expect(one.noticeTexts()).toEqual([]);
  });

  test('a page without changes of its own follows the other, and may undo that', async () => {
    const { one, other } = await bothOpen();
    other.capture(1500);
    await other.later();
    await one.library.refresh();
    expect(one.group().frames).toHaveLength(1);
    one.document.undo();
    expect(one.group().frames).toHaveLength(0);
    await one.later();
    await other.library.refresh();
    expect(other.group().frames).toHaveLength(0);
    expect([...one.noticeTexts(), ...other.noticeTexts()]).toEqual([]);
  });

  test('a change during a conflict is not lost', async () => {
    const { one, other, documentStore } = await bothOpen();
    one.capture(1);
    await one.later();
    other.capture(2);
    const flushed = other.library.refresh();
    other.capture(3);
    await flushed;
    await other.later();
    expect((await textAt(documentStore, other.openId()))!.frames).toHaveLength(2);
  });
});

describe('several documents', () => {
  test('each keeps its own steps while the page lives', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.capture(1500);
    const first = page.openId();
    await page.later();
    page.library.create();
    expect(page.group().frames).toHaveLength(0);
    page.document.edit(() => 'name', called('Second'));
    await page.later();
    await page.library.open(first);
    expect(page.group().frames).toHaveLength(1);
    page.document.undo();
    expect(page.group().frames).toHaveLength(0);
    page.document.redo();
    expect(page.document.store.getState().past.map(({ label }) => label())).toEqual(['capture']);
  });

  test('the copy of a group with the longest name there is has another name', async () => {
    const page = createPlace(createMemoryStore()).visit();
    const name = 'x'.repeat(GROUP_NAME_LENGTH);
    page.document.edit(() => 'name', called(name));
    await page.later();
    await page.library.duplicate(page.openId());
    expect(page.names()).toHaveLength(2);
    expect(new Set(page.names()).size).toBe(2);
  });

  test('a document is duplicated, renamed from the list, deleted and brought back', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.document.edit(() => 'name', called('Wave'));
    await page.later();
    await page.library.duplicate(page.openId());
    expect(page.names()).toEqual(['Wave', words.library.copyOf({ name: 'Wave' })]);
    const { documents, openId } = page.library.store.getState();
    const copy = documents.find(({ id }) => id !== openId)!.id;
    await page.library.change(copy, () => 'rename', called('Bow'));
    expect(page.names()).toEqual(['Bow', 'Wave']);
    await page.library.remove(copy);
    expect(page.names()).toEqual(['Wave']);
    page.act();
    await page.later();
    expect(page.names()).toEqual(['Bow', 'Wave']);
  });

  test('deleting the open one opens a new one; undo brings it back with its steps', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.capture(1500);
    await page.later();
    const id = page.openId();
    await page.library.remove(id);
    expect(page.openId()).not.toBe(id);
    expect(page.group().frames).toEqual([]);
    page.act();
    await page.later();
    expect(page.openId()).toBe(id);
    expect(page.document.store.getState().past).toHaveLength(1);
  });

  test('a version goes alone, and comes back where that is undone', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.capture(1500);
    await page.library.keepVersion(page.openId(), 'One');
    await page.library.keepVersion(page.openId(), 'Two');
    const names = async () => (await page.library.versions(page.openId())).map(({ name }) => name);
    const [one] = await page.library.versions(page.openId());
    await page.library.removeVersion(page.openId(), one!);
    expect(await names()).toEqual(['Two']);
    expect(page.noticeTexts()).toEqual([words.library.versionRemoved({ name: 'One' })]);
    page.act();
    await page.later();
    expect((await names()).sort()).toEqual(['One', 'Two']);
  });

  test('a version is renamed where it stands, and back where that is undone', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.capture(1500);
    await page.library.keepVersion(page.openId(), 'One');
    await page.library.keepVersion(page.openId(), 'Two');
    page.capture(1600);
    const stored = await page.library.versions(page.openId());
    await page.library.renameVersion(page.openId(), stored[0]!, 'Before the show');
    const renamed = { ...stored[0]!, name: 'Before the show' };
    expect(await page.library.versions(page.openId())).toEqual([renamed, stored[1]]);
    expect(page.noticeTexts()).toEqual([
      words.library.versionRenamed({ name: 'One', wanted: 'Before the show' }),
    ]);
    await page.library.restoreVersion(page.openId(), renamed);
    expect(page.group().frames).toHaveLength(1);
    page.act();
    await page.later();
    expect(await page.library.versions(page.openId())).toEqual(stored);
  });

  test('a named version stays as it was, and going back to it is a step', async () => {
    const { visit } = createPlace();
    const page = visit();
    page.capture(1500);
    await page.library.keepVersion(page.openId(), 'Before the show');
    page.capture(1600);
    const [version] = await page.library.versions(page.openId());
    await page.library.restoreVersion(page.openId(), version!);
    expect(page.group().frames).toHaveLength(1);
    page.document.undo();
    expect(page.group().frames).toHaveLength(2);
  });
});

describe('files', () => {
  async function twoGroups() {
    const place = createPlace();
    const page = place.visit();
    page.document.edit(() => 'name', called('Wave'));
    await page.library.keepVersion(page.openId(), 'First');
    page.library.create();
    page.document.edit(() => 'name', called('Bow'));
    page.capture(1500);
    await page.later();
    return { ...place, page, text: (await page.library.exportText())! };
  }

  test('a damaged group is reported by name, and one of its versions takes its place', async () => {
    const { visit, clock, documentStore } = createPlace();
    const first = visit();
    first.document.edit(() => 'rename', called('Wave'));
    first.capture(1500);
    await first.later();
    await first.library.keepVersion(first.openId(), 'First try');
    const id = first.openId();
    first.capture(1800);
    await first.later();

    let isDamaged = true;
    const damaged: DocumentStore = {
      ...documentStore,
      list: async () => ({ ...(await documentStore.list()), changesLost: true }),
      read: (wanted) =>
        isDamaged && wanted === id
          ? Promise.reject(new LibraryError('damaged', 'Wave is damaged.'))
          : documentStore.read(wanted),
      write: (wanted, writing) => {
        isDamaged = false;
        return documentStore.write(wanted, writing);
      },
    };
    const page = createVisit(damaged, clock);
    await page.later();
    await page.library.refresh();
    expect(page.noticeTexts().filter((text) => text === words.library.changesLost)).toHaveLength(1);
    await page.library.open(id);
    expect(page.noticeTexts()).toContain(libraryProblem('damaged', 'Wave is damaged.'));
    expect(page.openId()).not.toBe(id);

    const [version] = await page.library.versions(id);
    await page.library.restoreVersion(id, version!);
    expect(page.openId()).toBe(id);
    await page.later();
    expect(page.group().frames).toHaveLength(1);
    expect((await textAt(documentStore, id))?.frames).toHaveLength(1);
    expect(page.names()).toEqual(['Wave']);
  });

  test('all of a library moves to another place, with its versions', async () => {
    const { text } = await twoGroups();
    const elsewhere = createPlace();
    const other = elsewhere.visit();
    await other.library.importText(text);
    expect(other.names()).toEqual(['Bow', 'Wave']);
    expect(other.noticeTexts()).toEqual([words.library.imported({ added: 2, changed: 0, same: 0 })]);
    const wave = other.library.store.getState().documents.find(({ facts }) => facts.name === 'Wave')!;
    expect((await other.library.versions(wave.id)).map(({ name }) => name)).toEqual(['First']);
    expect(JSON.parse((await other.library.exportText())!)).toEqual(JSON.parse(text));
  });

  const documentsIn = (text: string | null): readonly BundledDocument[] => {
    const read = libraryFromText(text ?? '');
    return 'value' in read ? read.value.documents : [];
  };

  /** Those texts that `isBroken` says, by the name of their group or version. */
  function damagedAt(documentStore: DocumentStore, isBroken: (name: string) => boolean): DocumentStore {
    const whole = async (name: string | undefined): Promise<void> => {
      if (isBroken(name ?? '')) throw new LibraryError('damaged', `${name ?? ''} is damaged.`);
      return Promise.resolve();
    };
    return {
      ...documentStore,
      async read(id) {
        await whole((await documentStore.list()).documents.find((one) => one.id === id)?.facts.name);
        return documentStore.read(id);
      },
      async readVersion(id, version) {
        await whole((await documentStore.versions(id)).find((one) => one.id === version)?.name);
        return documentStore.readVersion(id, version);
      },
    };
  }

  test('an export holds all that is whole, and what is not is reported by name', async () => {
    const { text, documentStore, clock } = await twoGroups();
    const all = documentsIn(text);
    const exported = async (...broken: readonly string[]) => {
      const page = createVisit(
        damagedAt(documentStore, (name) => broken.includes(name)),
        clock,
      );
      const documents = documentsIn(await page.library.exportText());
      return { documents, noticeTexts: page.noticeTexts() };
    };
    expect(await exported('Bow')).toEqual({
      documents: all.filter(({ group }) => group.name === 'Wave'),
      noticeTexts: [
        words.library.exported({ count: 1 }),
        words.library.notExported({ names: words.numbers.formatNames(['Bow']) }),
      ],
    });
    expect(await exported('First')).toEqual({
      documents: all.map((document) => ({ ...document, versions: [] })),
      noticeTexts: [
        words.library.exported({ count: 2 }),
        words.library.notExported({
          names: words.numbers.formatNames([words.library.versionOf({ name: 'Wave', version: 'First' })]),
        }),
      ],
    });
    expect(await exported('Wave', 'Bow')).toEqual({
      documents: all.flatMap((document) => document.versions.map(({ group }) => ({ ...document, group }))),
      noticeTexts: [
        words.library.exported({ count: 1 }),
        words.library.notExported({
          names: words.numbers.formatNames([
            words.library.standsFor({ name: 'Wave', version: 'First' }),
            'Bow',
          ]),
        }),
      ],
    });
    const unlisted = createVisit(
      { ...documentStore, versions: () => Promise.reject(new LibraryError('damaged', '')) },
      clock,
    );
    expect(documentsIn(await unlisted.library.exportText())).toHaveLength(2);
    expect(unlisted.noticeTexts()).toContain(
      words.library.notExported({
        names: words.numbers.formatNames(['Wave', 'Bow'].map((name) => words.library.versionsOf({ name }))),
      }),
    );
    expect(await exported('Wave', 'Bow', 'First')).toEqual({
      documents: [],
      noticeTexts: [expect.stringContaining(libraryProblem('damaged', '').trim()) as string],
    });
  });

  test('beside a damaged group an import puts its own', async () => {
    const { text, documentStore, clock } = await twoGroups();
    const page = createVisit(
      damagedAt(documentStore, (name) => name === 'Bow'),
      clock,
    );
    await page.library.importText(text);
    expect(page.names()).toEqual(['Bow', 'Bow', 'Wave']);
    expect(page.noticeTexts()).toContain(words.library.imported({ added: 0, changed: 1, same: 1 }));
  });

  test('what is there already stays; what differs comes beside it', async () => {
    const { text, page } = await twoGroups();
    page.capture(1700);
    await page.library.importText(text);
    expect(page.names()).toEqual(['Bow', 'Bow', 'Wave']);
    expect(page.noticeTexts()).toContain(words.library.imported({ added: 0, changed: 1, same: 1 }));
  });

  test('while the library is waited for, an import says so, and goes on once it answers', async () => {
    const { text } = await twoGroups();
    const clock = createVirtualClock();
    let answer = (_documentStore: DocumentStore): void => undefined;
    const page = createVisit(new Promise<DocumentStore>((resolve) => (answer = resolve)), clock);
    const imported = page.library.importText(text);
    await clock.advance(1000);
    expect(page.noticeTexts()).toEqual([words.library.importWaits]);
    answer(createMemoryStore());
    await imported;
    expect(page.noticeTexts()).toEqual([words.library.imported({ added: 2, changed: 0, same: 0 })]);
    expect(page.names()).toEqual(['Bow', 'Wave']);
  });

  test('each that is asked of a library that is away says why nothing came of it', async () => {
    const { text } = await twoGroups();
    const { flaky, state } = unreliable(createMemoryStore());
    const page = createPlace(flaky).visit();
    await page.later();
    state.isAway = true;
    page.capture(1500);
    await page.later();
    const noticeTexts = async (requested: Promise<unknown>): Promise<readonly string[]> => {
      for (const { id } of page.notices.store.getState()) page.notices.dismiss(id);
      await requested;
      return page.noticeTexts();
    };
    const away = libraryProblem('unreachable', '');
    expect(await noticeTexts(page.library.importText(text))).toEqual([
      words.library.importFailed({ problem: libraryProblem('unreachable', '') }),
    ]);
    expect(await noticeTexts(page.library.exportText())).toEqual([away]);
    expect(await noticeTexts(page.library.keepVersion(page.openId(), 'First'))).toEqual([away]);
    expect(await noticeTexts(page.library.remove(page.openId()))).toEqual([away]);
  });

  test('a file that breaks off in the middle brings nothing in', async () => {
    const { text } = await twoGroups();
    const documentStore = createMemoryStore();
    let writes = 0;
    const write: DocumentStore['write'] = (id, writing) =>
      ++writes > 1 ? Promise.reject(new LibraryError('full', 'no space')) : documentStore.write(id, writing);
    const other = createPlace({ ...documentStore, write }).visit();
    await other.library.importText(text);
    await other.library.refresh();
    expect(other.names()).toEqual([]);
    expect(other.noticeTexts()).toEqual([
      words.library.importFailed({ problem: libraryProblem('full', '') }),
    ]);
  });

  test.each(['', '{}', '[]', '{"format":"servodeck-library","version":2,"content":{"documents":[]}}'])(
    'a file that is no library changes nothing: %s',
    async (text) => {
      const { visit, documentStore } = createPlace();
      const page = visit();
      await page.library.importText(text);
      expect((await documentStore.list()).documents).toEqual([]);
      expect(page.noticeTexts()).toHaveLength(1);
    },
  );
});
