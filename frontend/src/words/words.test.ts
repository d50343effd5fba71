import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { LINK_ERROR_CODES } from '#shared/session/linkError.ts';
import { words } from './en.ts';
import { errorSentence } from './errors.ts';
import { formatAge, formatPosition, formatSeconds, formatVolts } from './numbers.ts';

const pageDir = join(import.meta.dirname, '..');
const sources = readdirSync(pageDir, { recursive: true, encoding: 'utf8' })
  .filter((path) => /\.tsx?$/u.test(path) && !path.includes('.test.') && !path.startsWith('words'))
  .map((path) => readFileSync(join(pageDir, path), 'utf8'))
  .join('\n');

/** Every text of the catalogue that takes no values, with its path. */
function plainTexts(value: unknown, path: string): [string, string][] {
  if (typeof value === 'string') return [[path, value]];
  if (typeof value !== 'object' || value === null) return [];
  return Object.entries(value).flatMap(([key, inner]) => plainTexts(inner, `${path}.${key}`));
}

describe('the words', () => {
  const texts = plainTexts(words, 'words');

  test('every failure of a link has a sentence of its own that ends like one', () => {
    const sentences = LINK_ERROR_CODES.map((code) => errorSentence(code, 'the detail'));
    expect(new Set(sentences).size).toBe(LINK_ERROR_CODES.length);
    for (const sentence of sentences) expect(sentence).toMatch(/^[A-Z].*\.$/u);
  });

  test('a detail is part of the sentence, and its absence leaves no gap', () => {
    expect(errorSentence('outOfRange', 'slot is 256')).toBe('The board cannot take this value: slot is 256.');
    expect(errorSentence('outOfRange')).toBe('The board cannot take this value.');
  });

  test('nothing shouts, nothing is empty', () => {
    for (const [path, text] of texts) {
      expect(text, path).not.toMatch(/!|oops/iu);
      expect(text.trim(), path).not.toBe('');
    }
  });

  test('every group of words is used by the page', () => {
    const leaves = Object.entries(words).flatMap(([group, inner]) =>
      typeof inner === 'object' ? Object.keys(inner).map((key) => `${group}.${key}`) : [group],
    );
    const unused = leaves.filter((leaf) => {
      const group = leaf.split('.')[0] ?? leaf;
      return !sources.includes(`words.${leaf}`) && !sources.includes(`words.${group}[`);
    });
    expect(unused).toEqual([]);
  });

  test('no panel writes a sentence of its own', () => {
    const written = [...sources.matchAll(/>\s*([A-Z][a-z]+(?: [a-z]+){2,})[^<{]*</gu)].map(
      (match) => match[1],
    );
    expect(written).toEqual([]);
  });
});

describe('numbers', () => {
  test('carry their unit', () => {
    expect(formatVolts(7480)).toBe('7.48\u00a0V');
    expect(formatPosition(1500, 'us')).toBe('1500 µs');
    expect(formatPosition(500, 'steps')).toBe('500 steps');
    expect(formatSeconds(4250)).toBe('4.3 sec');
  });

  test('ages are whole seconds, then minutes', () => {
    expect(formatAge(2600)).toBe('3 sec. ago');
    expect(formatAge(180_000)).toBe('3 min. ago');
  });
});
