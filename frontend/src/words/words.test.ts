import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { afterEach, describe, expect, test } from 'vitest';
import { emptyGroup } from '#shared/actions/group/group.ts';
import { LINK_ERROR_CODES } from '#shared/session/linkError.ts';
import { wholeEnglish as english } from './en/whole.ts';
import { words as wholeWords } from './whole.ts';
import { LANGUAGES, OWN_NAMES, preferredLanguage, speak, words } from './words.ts';
import { chinese } from './zh/chinese.ts';

const pageDir = join(import.meta.dirname, '..');
const sources = readdirSync(pageDir, { recursive: true, encoding: 'utf8' })
  .filter((path) => /\.tsx?$/u.test(path) && !path.includes('.test.') && !path.startsWith('words'))
  .map((path) => readFileSync(join(pageDir, path), 'utf8'))
  .join('\n');

const chineseDir = join(import.meta.dirname, 'zh');
const chineseSources = readdirSync(chineseDir)
  .map((path) => readFileSync(join(chineseDir, path), 'utf8'))
  .join('\n');

/** All modules of the page that come with this one, itself included: types do not, nor what is imported when it is wanted. */
function comesWith(path: string, found = new Set<string>()): Set<string> {
  if (found.has(path)) return found;
  found.add(path);
  const source = readFileSync(join(pageDir, path), 'utf8');
  for (const [, to = ''] of source.matchAll(/^(?:import|export)(?! type)[^;]*? from '([.][^']+[.]tsx?)';/gmu))
    comesWith(join(dirname(path), to), found);
  return found;
}

/** Every text of the catalogue that takes no values, with its path. */
function plainTexts(value: unknown, path: string): [string, string][] {
  if (typeof value === 'string') return [[path, value]];
  if (typeof value !== 'object' || value === null) return [];
  return Object.entries(value).flatMap(([key, inner]) => plainTexts(inner, `${path}.${key}`));
}

/** What every function of the catalogue makes of ones alone; those that take something else are left out. */
function saidOfOne(value: unknown): string[] {
  if (typeof value === 'object' && value !== null) return Object.values(value).flatMap(saidOfOne);
  if (typeof value !== 'function') return [];
  try {
    const said: unknown = (value as (...ones: number[]) => unknown)(1, 1, 1, 1, 1, 1);
    return typeof said === 'string' ? [said] : [];
  } catch {
    return [];
  }
}

describe('the words', () => {
  const texts = plainTexts(english, 'words');

  test('every failure of a link has a sentence of its own that ends like one', () => {
    const sentences = LINK_ERROR_CODES.map((code) => english.errorSentence(code, 'the detail'));
    expect(new Set(sentences).size).toBe(LINK_ERROR_CODES.length);
    for (const sentence of sentences) expect(sentence).toMatch(/^[A-Z].*\.$/u);
  });

  test('a detail is part of the sentence, and its absence leaves no gap', () => {
    expect(english.errorSentence('outOfRange', 'slot is 256')).toBe(
      'This value is out of range: slot is 256.',
    );
    expect(english.errorSentence('outOfRange')).toBe('This value is out of range.');
  });

  test('why a file of ours is refused is said in Chinese, with its place alone as the file has it', () => {
    for (const code of ['notOurs', 'otherVersion', 'badValue', 'servoTwice', 'poseMissing'] as const) {
      for (const said of [chinese.poses.importFailed, chinese.library.notImported])
        expect(said({ code, at: '7' }).replace('Servodeck', ''), code).not.toMatch(/[a-z]/iu);
    }
    expect(chinese.poses.importFailed({ code: 'badValue', at: 'content.poses' })).toContain('content.poses');
  });

  test('nothing shouts, nothing is empty', () => {
    for (const [path, text] of [...texts, ...plainTexts(chinese, 'chinese')]) {
      expect(text, path).not.toMatch(/[!！]|oops/iu);
      expect(text.trim(), path).not.toBe('');
    }
  });

  test('every group of words is used by the page', () => {
    const leaves = Object.entries(english).flatMap(([group, inner]) =>
      typeof inner === 'object' ? Object.keys(inner).map((key) => `${group}.${key}`) : [group],
    );
    // Other words are made of the numbers; the page reads only some of them.
    const unused = leaves.filter((leaf) => {
      const group = leaf.split('.')[0] ?? leaf;
      return (
        group !== 'numbers' &&
        group !== 'locale' &&
        !sources.includes(`words.${leaf}`) &&
        !sources.includes(`words.${group}[`)
      );
    });
    expect(unused).toEqual([]);
  });

  test('what only later parts say does not come with the first load', () => {
    const first = [...comesWith('main.tsx')];
    expect(first).toContain(join('words', 'en', 'english.ts'));
    expect(first.filter((path) => /words.(?:whole|en.whole|en.later)/u.test(path))).toEqual([]);
    expect(comesWith(join('files', 'FilesContent.tsx'))).toContain(join('words', 'en', 'later', 'files.ts'));
  });

  test('one of a thing is never called many', () => {
    const oneOfMany =
      /(^|[^\d.,])1 (bytes|frames|groups|keys|lines|others|packets|positions|runs|servos|slots|steps)\b/u;
    const said = saidOfOne(english);
    expect(said.length).toBeGreaterThan(100);
    expect(said.filter((text) => oneOfMany.test(text))).toEqual([]);
  });

  test('no panel writes a sentence of its own', () => {
    const written = [...sources.matchAll(/>\s*([A-Z][a-z]+(?: [a-z]+){2,})[^<{]*</gu)].map(
      (match) => match[1],
    );
    expect(written).toEqual([]);
  });

  test('how far off the board would be is a whole number with its unit, and what helps is said', () => {
    const problem = { kind: 'deviation', servo: 1, atMs: 2000, units: 44.556, limit: 5 } as const;
    const elbow = (): string => 'Elbow';
    expect(english.compile.problem(problem, emptyGroup('Wave', 'us'), elbow)).toMatch(
      /^Elbow at .* off by 45\sµs; 5\sµs is allowed\. Give it more time, or allow a larger error\.$/,
    );
    expect(chinese.compile.problem(problem, emptyGroup('Wave', 'us'), elbow)).toMatch(/^Elbow.*偏差45微秒/);
  });
});

/** Names, signs and keys that are the same to everybody. */
const SAME_IN_CHINESE = /^(Servodeck|zh-CN|Esc|Windows|macOS|Linux|ChromeOS|mV|– V|55 55 02 0F|[A-Z%°×?])$/u;

describe('Chinese', () => {
  test('no plain text is English, and none is punctuated like it', () => {
    for (const [path, text] of plainTexts(chinese, 'chinese')) {
      if (SAME_IN_CHINESE.test(text)) continue;
      expect(text, path).toMatch(/[\p{Script=Han}，]/u);
      expect(text, path).not.toMatch(/\p{Script=Han}[,.:;?!()]/u);
    }
  });

  test('no space is typed between a number and the characters around it', () => {
    // A name that ends with a figure stays a word; bytes are written as everywhere.
    const names = /(?<![A-Za-z])[A-Za-z]+-?\d+|55 55/gu;
    for (const [path, text] of plainTexts(chinese, 'chinese'))
      expect(text.replace(names, 'X'), path).not.toMatch(/\p{Script=Han} \d|\d \p{Script=Han}/u);
    const number = String.raw`\$\{(?:format\w+|span|rangeText)\((?:[^{}]|\{[^{}]*\})*\}`;
    const written = new RegExp(String.raw`\p{Script=Han} ${number}|${number}%? \p{Script=Han}`, 'gu');
    expect(chineseSources.match(written)).toBeNull();
  });

  test('every failure of a link has a sentence of its own that ends like one', () => {
    const sentences = LINK_ERROR_CODES.map((code) => chinese.errorSentence(code, '详情'));
    expect(new Set(sentences).size).toBe(LINK_ERROR_CODES.length);
    for (const sentence of sentences) expect(sentence).toMatch(/\p{Script=Han}.*。$/u);
  });

  test('writes numbers and units its own way', () => {
    expect(chinese.numbers.formatPosition(1500, 'us')).toBe('1500微秒');
    expect(chinese.numbers.formatMs(1500)).toBe('1500毫秒');
    expect(chinese.numbers.formatSeconds(4250)).toBe('4.3秒');
    expect(chinese.numbers.formatRoughly(2_951_900)).toBe('49分钟');
    expect(chinese.numbers.formatAge(180_000)).toBe('3分钟前');
    expect(chinese.numbers.formatList([1, 2, 3])).toBe('1、2和3');
  });
});

describe('the language', () => {
  afterEach(() => speak('en'));

  test('is the first one of the browser that there are words for', () => {
    expect(preferredLanguage(['de-AT', 'zh-Hans-CN', 'en'])).toBe('zh');
    expect(preferredLanguage(['en-GB', 'zh'])).toBe('en');
    expect(preferredLanguage(['ZH'])).toBe('zh');
    expect(preferredLanguage(['de'])).toBe('en');
    expect(preferredLanguage([])).toBe('en');
  });

  test('is what everybody reads once it is spoken', async () => {
    await speak('zh');
    expect(words.stop.button).toBe('停止');
    expect(wholeWords.files.save).toBe(chinese.files.save);
    await speak('en');
    expect(words.stop.button).toBe('Stop');
    expect(wholeWords.files.save).toBe(english.files.save);
  });

  test('is the one asked for last, however long the other takes to load', async () => {
    await Promise.all([speak('zh'), speak('en')]);
    expect(words.locale).toBe('en');
  });

  test('says of itself which it is', async () => {
    for (const language of LANGUAGES) {
      await speak(language);
      expect(words.locale).toBe(OWN_NAMES[language].locale);
    }
  });
});

describe('numbers', () => {
  test('carry their unit', () => {
    expect(english.numbers.formatVolts(7480)).toBe('7.48\u00a0V');
    expect(english.numbers.formatPosition(1500, 'us')).toBe('1500 µs');
    expect(english.numbers.formatPosition(500, 'steps')).toBe('500 steps');
    expect(english.numbers.formatSeconds(4250)).toBe('4.3 sec');
    expect(english.numbers.formatRoughly(119_000)).toBe('119.0 sec');
    expect(english.numbers.formatRoughly(2_951_900)).toBe('49 min');
  });

  test('ages are whole seconds, then tens of them, then minutes', () => {
    expect(english.numbers.formatAge(2600)).toBe('3 sec. ago');
    expect(english.numbers.formatAge(12_400)).toBe('10 sec. ago');
    expect(english.numbers.formatAge(56_000)).toBe('1 min. ago');
    expect(english.numbers.formatAge(180_000)).toBe('3 min. ago');
  });

  test.each([
    [0, '0 sec. ago'],
    [59_999, '59 sec. ago'],
    [60_000, '1 min. ago'],
    [7_199_999, '1 hr. ago'],
    [50 * 3_600_000, '2 days ago'],
  ])('a long age of %i ms is in its largest unit', (ms, text) => {
    expect(english.numbers.formatLongAge(ms)).toBe(text);
  });
});
