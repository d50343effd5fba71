// SQLite as this page serves it: a WebAssembly file of our own, fetched once and only when it is wanted.

import type { Sqlite } from './means.ts';

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
