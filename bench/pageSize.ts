// How much JavaScript a browser fetches before the dashboard is there: what index.html names, compressed as for the wire.

import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { at } from '../scripts/steps.mjs';
import type { Figure } from './figure.ts';

const STATIC = 'backend/servodeck/static';
/** What the page may grow to; React with a library's accessible dialog, tabs and slider alone is 109 KiB. */
const LIMIT_KIB = 200;

export function measurePageSize(): Figure[] {
  const scripts = scriptsOf(readFileSync(at(`${STATIC}/index.html`), 'utf8'));
  const bytes = scripts.reduce((sum, script) => sum + compressedBytes(script), 0);
  const note = `${scripts.length} script${scripts.length === 1 ? '' : 's'}, gzip level 9; React and basic widgets alone: 109`;
  return [
    {
      ...{ key: 'page.jsGzKiB', value: bytes / 1_024, unit: 'KiB', note },
      against: { what: 'limit', value: LIMIT_KIB },
    },
  ];
}

/** The entry and what it imports at once, which the bundler lists as preloads. */
function scriptsOf(html: string): readonly string[] {
  const named = [...html.matchAll(/<(?:script|link rel="modulepreload")[^>]* (?:src|href)="([^"]+\.js)"/g)];
  if (named.length === 0) throw new Error('index.html names no script');
  return [...new Set(named.map(([, address = '']) => address))];
}

function compressedBytes(address: string): number {
  return gzipSync(readFileSync(at(`${STATIC}/${address}`)), { level: 9 }).length;
}
