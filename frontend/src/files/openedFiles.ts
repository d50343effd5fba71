// Files that were opened and not yet taken over, read one by one, with what was answered about them. Knows no document and no
// dialog.

import { useState } from 'react';
import { MAX_FILE_BYTES, readGroupFile } from '#shared/actions/files/readGroupFile.ts';
import type { Problem, Reading } from '#shared/actions/files/reading.ts';
import { firstAnswers, type Answer, type AnsweredFile } from './answers.ts';
import { fileMeans } from './means.ts';
import { loadSqlite } from './sqlite.ts';

/** `reading` is null while it is being read. */
export interface OpenedFile extends AnsweredFile {
  readonly name: string;
}

export interface OpenedFiles {
  readonly list: readonly OpenedFile[];
  open(files: readonly File[]): void;
  /** About the group at `index` of the file. */
  answer(id: number, index: number, change: Partial<Answer>): void;
  drop(...ids: readonly number[]): void;
}

const means = fileMeans(loadSqlite);
let nextId = 1;

export function useOpenedFiles(): OpenedFiles {
  const [list, setList] = useState<readonly OpenedFile[]>([]);

  function open(files: readonly File[]): void {
    const added = files.map((file) => ({ file, id: nextId++ }));
    setList((before) => [
      ...added.map(({ file, id }) => ({ id, name: file.name, reading: null, answers: [] })),
      ...before,
    ]);
    for (const { file, id } of added)
      void readingOf(file).then((reading) =>
        setList((before) =>
          before.map((one) => (one.id === id ? { ...one, reading, answers: firstAnswers(reading) } : one)),
        ),
      );
  }

  function answer(id: number, index: number, change: Partial<Answer>): void {
    const changed = (before: readonly Answer[]): readonly Answer[] =>
      before.map((one, place) => (place === index ? { ...one, ...change } : one));
    setList((before) =>
      before.map((one) => (one.id === id ? { ...one, answers: changed(one.answers) } : one)),
    );
  }

  return {
    ...{ list, open, answer },
    drop: (...ids) => setList((before) => before.filter((one) => !ids.includes(one.id))),
  };
}

async function readingOf(file: File): Promise<Reading> {
  if (file.size > MAX_FILE_BYTES) return problem('tooLarge');
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    return await readGroupFile({ name: file.name, bytes }, means);
  } catch {
    return problem('unreadable');
  }
}

const problem = (code: Problem['code']): Reading => ({ problem: { code, place: null, found: '' } });
