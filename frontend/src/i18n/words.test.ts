import { words as english } from 'virtual:words/en/rest';
import { words as chinese } from 'virtual:words/zh';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, describe, expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { LinkError, LINK_ERROR_CODES } from '#shared/robot/linkError.ts';
import { datesIn, words as wholeWords } from './whole.ts';
import { boardName, errorSentence, flawSentence, linkSentence } from './sentences.ts';
import { LANGUAGE_CODES, preferredLanguage, speak, words } from './words.ts';

afterEach(() => speak('en'));

describe('the sentences', () => {
  test('every failure of a link has one of its own that ends like one', async () => {
    const sentences = (): readonly string[] => LINK_ERROR_CODES.map((code) => errorSentence(code, '详情'));
    expect(new Set(sentences()).size).toBe(LINK_ERROR_CODES.length);
    for (const sentence of sentences()) expect(sentence).toMatch(/^[A-Z].*\.$/u);
    await speak('zh');
    expect(new Set(sentences()).size).toBe(LINK_ERROR_CODES.length);
    for (const sentence of sentences()) expect(sentence).toMatch(/\p{Script=Han}.*。$/u);
  });

  test('a detail is part of the sentence, and its absence leaves no gap', () => {
    expect(errorSentence('outOfRange', 'slot is 256')).toBe('This value is out of range: slot is 256.');
    expect(errorSentence('outOfRange', 'slot is 256.')).toBe('This value is out of range: slot is 256.');
    expect(errorSentence('outOfRange')).toBe('This value is out of range.');
    expect(errorSentence('latched', 'the link is latched')).toBe(english.errors.latched);
  });

  test('a port that another program has names the program, in each language', async () => {
    const busy = new LinkError('portBusy', 'minicom (7) has it.', { heldBy: ['minicom (7)', 'cat (9)'] });
    const sentence = linkSentence(busy);
    expect(sentence).toBe(
      'This port is open in minicom (7), cat (9). Close it there. Servodeck keeps trying.',
    );
    expect(linkSentence(new LinkError('portBusy', ''))).toBe(english.errors.portBusy);
    await speak('zh');
    expect(linkSentence(busy)).toMatch(/minicom \(7\)，cat \(9\).*\p{Script=Han}/u);
  });

  test('what a program says in English is left out of another language, but for a bug report', async () => {
    await speak('zh');
    expect(errorSentence('gatewayRefused', 'slot is 256')).toBe(chinese.errors.gatewayRefused);
    expect(errorSentence('outOfRange', '槽位是256')).toContain('槽位是256');
    expect(errorSentence('internal', 'x is undefined')).toContain('x is undefined');
  });

  test('why a file of ours is refused is said in Chinese, with its place alone as the file has it', async () => {
    await speak('zh');
    for (const code of ['notOurs', 'otherVersion', 'badValue', 'servoTwice', 'poseMissing'] as const)
      expect(flawSentence({ code, at: '7' }).replace('Servodeck', ''), code).not.toMatch(/[a-z]/iu);
    expect(flawSentence({ code: 'badValue', at: 'content.poses' })).toContain('content.poses');
  });

  test('boards are called as their maker names them, or as a language has it', async () => {
    for (const family of Object.values(FAMILIES)) expect(boardName(family)).toBe(family.name);
    await speak('zh');
    expect(boardName(FAMILIES['lsc-6'])).toBe('LSC-6');
    expect(boardName(FAMILIES['bus-ctrl'])).toBe('总线舵机控制板');
  });
});

test('no panel writes a sentence of its own', () => {
  const page = join(import.meta.dirname, '..');
  const sources = readdirSync(page, { recursive: true, encoding: 'utf8' })
    .filter((path) => /\.tsx?$/u.test(path) && !path.includes('.test.'))
    .map((path) => readFileSync(join(page, path), 'utf8'))
    .join('\n');
  const written = [...sources.matchAll(/>\s*([A-Z][a-z]+(?: [a-z]+){2,})[^<{]*</gu)].map((match) => match[1]);
  expect(written).toEqual([]);
});

describe('the language', () => {
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
    for (const language of LANGUAGE_CODES) {
      await speak(language);
      expect(new Intl.Locale(words.locale).language).toBe(language);
    }
  });
});

describe('numbers', () => {
  test('carry their unit', () => {
    expect(english.numbers.formatVolts(7480)).toBe('7.48\u00a0V');
    expect(english.position.us({ position: 1500 })).toBe('1500 µs');
    expect(english.position.steps({ position: 500 })).toBe('500 steps');
    expect(english.numbers.formatSeconds(4250)).toBe('4.3 sec');
    expect(english.numbers.formatRoughly(119_000)).toBe('119.0 sec');
    expect(english.numbers.formatRoughly(2_951_900)).toBe('49 min');
  });

  test('are written in each language its own way', () => {
    expect(chinese.position.us({ position: 1500 })).toBe('1500微秒');
    expect(chinese.numbers.formatMs(1500)).toBe('1500毫秒');
    expect(chinese.numbers.formatSeconds(4250)).toBe('4.3秒');
    expect(chinese.numbers.formatRoughly(2_951_900)).toBe('49分钟');
    expect(chinese.numbers.formatAge(180_000)).toBe('3分钟前');
    expect(chinese.numbers.formatList([1, 2, 3])).toBe('1、2和3');
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
    expect(datesIn('en').formatLongAge(ms)).toBe(text);
  });
});
