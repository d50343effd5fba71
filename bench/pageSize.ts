// How much JavaScript there is, compressed as for the wire: what a browser fetches before the dashboard is there, which is what
// index.html names, and all that may come later.

import { readdirSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { at } from '../scripts/steps.mjs';
import type { Figure } from './figure.ts';

const STATIC = 'backend/servodeck/static';
/** What the first load is to come down to; React with a library's accessible dialog, tabs and slider alone is 109 KiB. */
const LIMIT_KIB = 180;

export function measurePageSize(): Figure[] {
  const first = scriptsOf(readFileSync(at(`${STATIC}/index.html`), 'utf8'));
  const all = readdirSync(at(`${STATIC}/assets`)).filter((name) => name.endsWith('.js'));
  return [
    {
      ...{ key: 'page.firstLoadJsGzKiB', value: compressedKiB(first), unit: 'KiB' },
      note: `before the dashboard is there, ${first.length} scripts, gzip level 9; React and basic widgets alone: 109`,
      limit: { atMost: LIMIT_KIB },
    },
    {
      ...{ key: 'page.jsGzKiB', value: compressedKiB(all.map((name) => `assets/${name}`)), unit: 'KiB' },
      note: `all ${all.length} scripts: with what comes when it is asked for, workers and the other language`,
    },
  ];
}

/** The entry and what it imports at once, which the bundler lists as preloads. */
function scriptsOf(html: string): readonly string[] {
  const named = [...html.matchAll(/<(?:script|link rel="modulepreload")[^>]* (?:src|href)="([^"]+\.js)"/g)];
  if (named.length === 0) throw new Error('index.html names no script');
  return [...new Set(named.map(([, address = '']) => address))];
}

function compressedKiB(addresses: readonly string[]): number {
  const bytesOf = (address: string): number =>
    gzipSync(readFileSync(at(`${STATIC}/${address}`)), { level: 9 }).length;
  return addresses.reduce((sum, address) => sum + bytesOf(address), 0) / 1_024;
}
