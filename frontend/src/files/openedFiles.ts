// Files that were opened and not yet taken over, read one by one. Knows no document and no dialog.

import { useState } from 'react';
import { MAX_FILE_BYTES, readGroupFile } from '#shared/actions/files/readGroupFile.ts';
import type { Problem, Reading } from '#shared/actions/files/reading.ts';
import { fileMeans } from './means.ts';
import { loadSqlite } from './sqlite.ts';

export interface OpenedFile {
  readonly id: number;
  readonly name: string;
  /** null while it is being read. */
  readonly reading: Reading | null;
}

export interface OpenedFiles {
  readonly list: readonly OpenedFile[];
  open(files: readonly File[]): void;
  drop(id: number): void;
}

const means = fileMeans(loadSqlite);
let nextId = 1;

export function useOpenedFiles(): OpenedFiles {
  const [list, setList] = useState<readonly OpenedFile[]>([]);

  function open(files: readonly File[]): void {
    const added = files.map((file) => ({ file, id: nextId++ }));
    setList((before) => [
      ...added.map(({ file, id }) => ({ id, name: file.name, reading: null })),
      ...before,
    ]);
    for (const { file, id } of added)
      void readingOf(file).then((reading) =>
        setList((before) => before.map((one) => (one.id === id ? { ...one, reading } : one))),
      );
  }

  return { list, open, drop: (id) => setList((before) => before.filter((one) => one.id !== id)) };
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
