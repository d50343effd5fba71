// Reads a file with what the browser provides to the pure file readers: the text decoder, and SQLite for .d6a files, a WebAssembly file of
// this page that is fetched when the first such file is opened or saved. Knows tables, no action group.

import { MAX_FILE_BYTES, readGroupFile, type Means } from '#shared/files/readGroupFile.ts';
import { Unreadable, type Decode, type Problem, type Reading } from '#shared/files/reading.ts';
import { INDEX_COLUMN, type Sheet } from '#shared/files/csv.ts';
import type { MakeDatabase } from '#shared/files/writeGroupFile.ts';
import { MAX_FRAMES } from '#shared/group/group.ts';

/** The part of SQLite in use. */
export interface Sqlite {
  readonly Database: new (bytes?: Uint8Array) => Database;
}

interface Database {
  exec(sql: string): readonly { readonly columns: readonly string[]; readonly values: readonly Cell[][] }[];
  run(sql: string, values?: Cell[]): unknown;
  export(): Uint8Array;
  close(): void;
}

type Cell = number | string | Uint8Array | null;

export interface FileMeans extends Means {
  readonly makeDatabase: MakeDatabase;
}

export function fileMeans(loadSqlite: () => Promise<Sqlite>): FileMeans {
  return {
    decode,
    openDatabase: async (bytes) => withDatabase(await loadSqlite(), sheetIn, bytes),
    makeDatabase: async (sheet) =>
      withDatabase(await loadSqlite(), (database) => {
        fill(database, sheet);
        return new Uint8Array(database.export());
      }),
  };
}

const decode: Decode = (bytes, encoding) => {
  try {
    return new TextDecoder(encoding, { fatal: true }).decode(bytes);
  } catch {
    return null;
  }
};

function withDatabase<T>({ Database }: Sqlite, work: (database: Database) => T, bytes?: Uint8Array): T {
  const database = new Database(bytes);
  try {
    return work(database);
  } finally {
    database.close();
  }
}

const TABLE = 'ActionGroup';
/** One more than a group may have shows that there are too many, and it ends a table without an end. */
const ROW_LIMIT = MAX_FRAMES + 1;

/** Reads only a table: a view could compute for ever. */
function sheetIn(database: Database): Sheet {
  database.run('PRAGMA trusted_schema = OFF');
  const named = database.exec(
    `SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = '${TABLE}' COLLATE NOCASE
     AND sql NOT LIKE 'CREATE VIRTUAL%'`,
  );
  if (named.length === 0) throw new Unreadable('noTable', TABLE);
  const columns = database
    .exec(`SELECT name FROM pragma_table_info('${TABLE}')`)
    .flatMap(({ values }) => values.map(([name]) => textOf(name)));
  const order = columns.find((column) => column.toLowerCase() === INDEX_COLUMN.toLowerCase());
  const rows = database.exec(
    `SELECT * FROM ${TABLE} ORDER BY ${order === undefined ? 'rowid' : '"Index"'} LIMIT ${ROW_LIMIT}`,
  );
  return {
    columns,
    rows: rows.flatMap(({ values }) =>
      values.map((cells, index) => ({ place: { frame: index + 1 }, cells: cells.map(textOf) })),
    ),
  };
}

const textOf = (cell: Cell | undefined): string =>
  typeof cell === 'string' || typeof cell === 'number'
    ? String(cell)
    : cell instanceof Uint8Array
      ? '(bytes)'
      : '';

/** As in the vendors' programs. Columns are `Index`, `Time` and `ServoN`, so the SQL contains no text from a file. */
function fill(database: Database, { columns, rows }: Sheet): void {
  const declared = columns.map((column) =>
    column === INDEX_COLUMN ? `"${column}" INTEGER PRIMARY KEY AUTOINCREMENT` : `"${column}" INT`,
  );
  database.run(`CREATE TABLE ${TABLE} (${declared.join(', ')})`);
  const places = columns.map(() => '?').join(', ');
  database.run('BEGIN');
  for (const { cells } of rows)
    database.run(
      `INSERT INTO ${TABLE} VALUES (${places})`,
      cells.map((cell) => (cell === '' ? null : Number(cell))),
    );
  database.run('COMMIT');
}

let loading: Promise<Sqlite> | null = null;

export function loadSqlite(): Promise<Sqlite> {
  loading ??= load();
  loading.catch(() => (loading = null));
  return loading;
}

async function load(): Promise<Sqlite> {
  const [{ default: start }, { default: address }] = await Promise.all([
    import('sql.js'),
    import('sql.js/dist/sql-wasm-browser.wasm?url'),
  ]);
  return start({ locateFile: () => address });
}

const means = fileMeans(loadSqlite);

/** Of any known format; in the worker, or in the page if there is none. Never rejects. */
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
