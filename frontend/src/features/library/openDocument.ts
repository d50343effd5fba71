// The open document of the library: remembered for the next visit, with the undo histories of documents that were open before. Knows no
// document store.

import * as v from 'valibot';
import { type ActionGroup, groupFromText, sameGroup } from '#shared/group/group.ts';
import { LibraryError, type Listed } from '#shared/files/documentStore.ts';
import { record, startHistory, type History, type Label } from '#shared/document/history.ts';
import type { Document } from '../groupDocument.ts';
import { saveText, type TextStorage } from '../../state/storage.ts';

/** Parses the text of a group. Throws a LibraryError if this version cannot read it. */
export function groupOf(text: string): ActionGroup {
  const read = groupFromText(text);
  if ('problem' in read) throw new LibraryError('unreadable', read.problem.code);
  return read.value;
}

/** `now` with the objects of `before` where they are equal, so that their cards do not render again. */
export function unchanged(before: readonly Listed[], now: readonly Listed[]): readonly Listed[] {
  const known = new Map(before.map((one) => [one.id, one]));
  const shared = now.map((one) => {
    const same = known.get(one.id);
    return same !== undefined && JSON.stringify(same) === JSON.stringify(one) ? same : one;
  });
  return shared.length === before.length && shared.every((one, index) => one === before[index])
    ? before
    : shared;
}

interface OpenDocument {
  id(): string;
  /** The revision that the document here is based on; 0 if the library has never had it. */
  revisionOf(id: string): number;
  setRevision(id: string, revision: number): void;
  /** True if an earlier visit had a document open. */
  readonly wasRemembered: boolean;
  /** Opens a document with its earlier history. Changes that other people made meanwhile are one more step, `label`. */
  show(id: string, group: ActionGroup, label: Label): void;
  /** The open group becomes another document of the library. */
  become(id: string): void;
}

const KEY = 'servodeck.group.open';
const schema = v.object({
  id: v.pipe(v.string(), v.minLength(1)),
  revision: v.pipe(v.number(), v.safeInteger(), v.minValue(0)),
});

export function createOpenDocument(
  document: Document,
  storage: TextStorage,
  newId: () => string,
): OpenDocument {
  const remembered = load(storage);
  let id = remembered?.id ?? newId();
  const revisions = new Map([[id, remembered?.revision ?? 0]]);
  const histories = new Map<string, History<ActionGroup>>();

  const revisionOf = (of: string): number => revisions.get(of) ?? 0;

  /** Where storage is forbidden, the document has already reported it. */
  const remember = (): void => saveText(storage, KEY, JSON.stringify({ id, revision: revisionOf(id) }));

  // Now, so that changes made before the first answer are found under this id again.
  remember();

  function become(other: string): void {
    id = other;
    remember();
  }

  return {
    id: () => id,
    revisionOf,
    setRevision(of, revision) {
      revisions.set(of, revision);
      if (of === id) remember();
    },
    wasRemembered: remembered !== null,
    show(other, group, label) {
      document.commit();
      histories.set(id, document.store.getState());
      become(other);
      document.take(goneOn(histories.get(other), group, label));
    },
    become,
  };
}

function goneOn(
  history: History<ActionGroup> | undefined,
  group: ActionGroup,
  label: Label,
): History<ActionGroup> {
  if (history !== undefined && sameGroup(history.present, group)) return history;
  const isFresh = history === undefined || history.past.length + history.future.length === 0;
  return isFresh ? startHistory(group) : record(history, label, group);
}

function load(storage: TextStorage): v.InferOutput<typeof schema> | null {
  try {
    return v.parse(schema, JSON.parse(storage.getItem(KEY) ?? 'null'));
  } catch {
    return null;
  }
}
