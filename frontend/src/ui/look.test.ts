import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const pageDir = join(import.meta.dirname, '..');
const sheets = readdirSync(pageDir, { recursive: true, encoding: 'utf8' })
  .filter((path) => path.endsWith('.css') && !path.endsWith('tokens.css'))
  .map((path) => [path, readFileSync(join(pageDir, path), 'utf8')] as const);

const RADII = ['0', 'var(--radius)', 'var(--radius-inner)', 'var(--round)'];
const SIZES = ['inherit', ...['s', 'm', 'l', 'xl', 'huge'].map((size) => `var(--text-${size})`)];

test.each([
  ['corners', /border(?:-\w+)*-radius:\s*([^;]+);/gu, RADII],
  ['letters', /font-size:\s*([^;]+);/gu, SIZES],
])('%s come from the tokens in every style sheet', (_, pattern, allowed) => {
  const others = sheets.flatMap(([path, text]) =>
    [...text.matchAll(pattern)]
      .filter(([, value]) => value?.split(/\s+/u).some((part) => !allowed.includes(part)))
      .map(([found]) => `${path}: ${found}`),
  );
  expect(others).toEqual([]);
});
