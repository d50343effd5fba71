// Reads a file of any known format, in the worker, or in the page if there is none. Never rejects.

import { MAX_FILE_BYTES, readGroupFile } from '#shared/files/readGroupFile.ts';
import type { Problem, Reading } from '#shared/files/reading.ts';
import { fileMeans, loadSqlite } from './means.ts';

const means = fileMeans(loadSqlite);

export async function readFile(file: File): Promise<Reading> {
  if (file.size > MAX_FILE_BYTES) return problem('tooLarge');
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    return await readGroupFile({ name: file.name, bytes }, means);
  } catch {
    return problem('unreadable');
  }
}

const problem = (code: Problem['code']): Reading => ({ problem: { code, place: null, found: '' } });
