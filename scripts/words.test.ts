// What the files of messages hold, in each language, and what the page's modules of words are made of.

import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { afterEach, describe, expect, test, vi } from 'vitest';
import { firstKeys, languages, messagesOf, moduleText, readTree, typesText, valuesOf } from './words.mjs';

const SOURCES = join(import.meta.dirname, '..', 'frontend', 'src');
const SHARED = join(import.meta.dirname, '..', 'shared', 'src');
const DOCUMENTS = join(import.meta.dirname, '..', 'docs');
const others = languages().filter((language) => language !== 'en');

/** The gateway's types among them: its values are keys of messages, too. */
function sourcesIn(folder: string): readonly string[] {
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((path) => /\.tsx?$/u.test(path) && !/\.test\.|words\.generated\./u.test(path))
    .map((path) => readFileSync(join(folder, path), 'utf8'));
}

/** What a message says whatever its values are. */
const plainText = (message: string): string => message.replaceAll(/\{\w+(?:, \w+(?:, ::?[\w-]+)?)?\}/gu, 'X');

describe('the messages', () => {
  const english = messagesOf(readTree('en'));

  test.each(others)('in %s are the same as in English, with the same values', (language) => {
    const shape = (messages: readonly (readonly [string, string])[]): Record<string, string> =>
      Object.fromEntries(
        messages.map(([key, message]) => [key, [...valuesOf(message)].map(String).sort().join(' ')]),
      );
    expect(shape(messagesOf(readTree(language)))).toEqual(shape(english));
  });

  test.each(languages())('in %s neither shout nor are empty', (language) => {
    for (const [key, message] of messagesOf(readTree(language))) {
      expect(message, key).not.toMatch(/[!！]|oops/iu);
      expect(message.trim(), key).not.toBe('');
    }
  });

  test('each is read somewhere in the page', () => {
    const sources = sourcesIn(SOURCES);
    const page = sources.join('\n');
    const all = [page, ...sourcesIn(SHARED)].join('\n');
    const read = new Set(
      [...page.matchAll(/\bwords((?:\s*\.\s*\w+)+)/gu)].map(([, chain = '']) =>
        chain.replaceAll(/\s/gu, '').slice(1),
      ),
    );
    const known = new Set(all.match(/[\w-]+/gu));
    const unused = english.filter(([key]) => {
      const parts = key.split('.');
      const isRead = (count: number): boolean => read.has(parts.slice(0, count).join('.'));
      if (isRead(parts.length)) return false;
      const group = parts.findIndex((_, at) => at > 0 && isRead(at));
      return group < 0 || !parts.slice(group).every((part) => known.has(part));
    });
    expect(unused.map(([key]) => key)).toEqual([]);
  });

  test('one of a thing is never called many', () => {
    const counts =
      /\{(\w+), number\} (?:bytes|frames|groups|keys|lines|packets|positions|runs|servos|slots|steps)\b/u;
    const fixed = english.filter(([, message]) => counts.test(message)).map(([key]) => key);
    expect(fixed).toEqual([]);
  });
});

describe('Chinese', () => {
  /** Names, signs and keys that are the same to everybody. */
  const SAME =
    /^(zh-CN|Servodeck|Esc|Windows|macOS|Linux|ChromeOS|START|SELECT|XML|CSV|Python|Arduino|\.\w+|m?V|– V|55 55 02 0F|[A-Z%°×?→≈>– ]|[LR][12])*$/u;

  test('no message is English, and none is punctuated like it', () => {
    for (const [key, message] of messagesOf(readTree('zh'))) {
      const text = plainText(message).replaceAll(
        /\{\w+, (?:plural|select),|(?:other|true|one|us|=\d) \{|#|\}/gu,
        'X',
      );
      if (!SAME.test(text.replaceAll('X', '')))
        expect(text, key).toMatch(/[\p{Script=Han}，。：；（）、“”]/u);
      expect(text, key).not.toMatch(/\p{Script=Han}[,.:;?!()]/u);
    }
  });

  test('no space is typed between a number and the characters around it', () => {
    // A name that ends with a figure stays a word; bytes are written as everywhere.
    const names = /(?<![A-Za-z])[A-Za-z]+-?\d+|55 55/gu;
    for (const [key, message] of messagesOf(readTree('zh'))) {
      const text = message.replaceAll(/\{\w+, number(?:, ::?[\w-]+)?\}|#/gu, '7').replaceAll(names, 'X');
      expect(text, key).not.toMatch(/\p{Script=Han} \d|\d \p{Script=Han}/u);
    }
  });
});

describe('the documents', () => {
  const GUIDES = [
    'animate',
    'connect',
    'drive',
    'index',
    'inputs',
    'network',
    'robot',
    'timeline',
    'troubleshooting',
  ];
  const textOf = (name: string): string =>
    readFileSync(join(DOCUMENTS, name), 'utf8').replaceAll(/```[^]*?```|`[^`\n]*`/gu, '');
  const isSaid = (language: string): ((quoted: string) => boolean) => {
    const messages = messagesOf(readTree(language)).map(([, message]) => message.toLowerCase());
    // A gap stands for a value.
    return (quoted) =>
      quoted.includes(' … ') || messages.some((message) => message.includes(quoted.toLowerCase()));
  };

  test.each(GUIDES)('name what is on the page as the page does: %s.md', (name) => {
    const text = textOf(`${name}.md`);
    const controls = [...text.matchAll(/(?<![\w_])_([^_\n]+)_(?![\w_])/gu)].map(
      ([, control = '']) => control,
    );
    const sentences = [...text.matchAll(/^> “(.+)”$/gmu)].map(([, sentence = '']) => sentence);
    expect([...controls, ...sentences].filter((quoted) => !isSaid('en')(quoted))).toEqual([]);
  });

  test('say in Chinese what the page says in Chinese', () => {
    const pages = readdirSync(DOCUMENTS).filter((name) => name.endsWith('.zh.md'));
    const quoted = pages.flatMap((name) =>
      [...textOf(name).matchAll(/“([^”]+)”/gu)].map(([, said = '']) => said),
    );
    expect(pages).toHaveLength(5);
    expect(quoted.filter((said) => !isSaid('zh')(said))).toEqual([]);
  });
});

describe('a module of messages', () => {
  const TREE = {
    locale: 'en',
    plain: 'No `values`, $ 5',
    group: {
      open: 'Open {label}',
      frames: '{count, plural, one {# frame} other {# frames}} of {limit, number, ::group-off}',
      times: '{times, plural, =0 {until stopped} one {once} other {# times}}',
      kept: '{isKept, select, true {kept} other {lost}} in {unit, select, us {µs} other {steps}}',
    },
  };

  /** Evaluates it as the bundler would, with formatters that show that they were called. */
  function evaluated(text: string, first: object = {}): Record<string, never> {
    const body = text.replaceAll(/^import .*$/gmu, '').replace('export const words =', 'return');
    const numbers = {
      formatCount: (value: number) => `<${value}>`,
      formatWhole: (value: number) => `[${value}]`,
      plural: (count: number) => (count === 1 ? 'one' : 'other'),
    };
    // oxlint-disable-next-line no-implied-eval, typescript/no-unsafe-call -- the text is the module under test
    return new Function('numbersIn', 'first', body)(() => numbers, { ...first, numbers }) as Record<
      string,
      never
    >;
  }

  test('has each message as a text or as a function of its values', () => {
    const { plain, group } = evaluated(moduleText(TREE)) as unknown as typeof WORDS;
    expect(plain).toBe('No `values`, $ 5');
    expect(group.open({ label: 'COM3' })).toBe('Open COM3');
    expect(group.frames({ count: 1, limit: 255 })).toBe('<1> frame of [255]');
    expect(group.frames({ count: 2, limit: 255 })).toBe('<2> frames of [255]');
    expect([0, 1, 2].map((times) => group.times({ times }))).toEqual(['until stopped', 'once', '<2> times']);
    expect(group.kept({ isKept: true, unit: 'us' })).toBe('kept in µs');
    expect(group.kept({ isKept: false, unit: 'steps' })).toBe('lost in steps');
  });

  test('may be cut in two, of which the second has all', () => {
    const isFirst = (key: string): boolean => key === 'group.open';
    const first = evaluated(moduleText(TREE, { isWanted: isFirst })) as unknown as typeof WORDS;
    expect(Object.keys(first.group)).toEqual(['open']);
    const rest = moduleText(TREE, { isWanted: (key) => !isFirst(key), first: 'first' });
    expect(rest).not.toContain('Open');
    const whole = evaluated(rest, first) as unknown as typeof WORDS;
    expect(whole.group.open({ label: 'COM3' })).toBe('Open COM3');
    expect(whole.group.times({ times: 1 })).toBe('once');
    expect(whole.plain).toBe(TREE.plain);
  });

  test('types each message by the values that it names', () => {
    expect(typesText(TREE)).toContain('readonly plain: string;');
    expect(typesText(TREE)).toContain('readonly open: (values: { readonly label: string }) => string;');
    expect(typesText(TREE)).toContain('{ readonly isKept: boolean; readonly unit: string }');
    expect(typesText(TREE)).toContain('{ readonly count: number; readonly limit: number }');
  });

  test.each(['{count, plural, one {#}}', '{open', 'Press <b>Stop</b>', '{count, number, ::compact-short}'])(
    '“%s” is refused with the message in the reason',
    (message) => {
      expect(() => moduleText({ locale: 'en', message })).toThrow(message);
    },
  );

  const WORDS = {
    plain: '',
    group: {
      open: (_: { label: string }): string => '',
      frames: (_: { count: number; limit: number }): string => '',
      times: (_: { times: number }): string => '',
      kept: (_: { isKept: boolean; unit: string }): string => '',
    },
  };
});

describe('the first load', () => {
  afterEach(() => vi.restoreAllMocks());

  /** All modules of the page that come with this one, itself included: types do not, nor what is imported when it is wanted. */
  function comesWith(path: string, found = new Set<string>()): Set<string> {
    if (found.has(path)) return found;
    found.add(path);
    const source = readFileSync(join(SOURCES, path), 'utf8');
    for (const [, to = ''] of source.matchAll(
      /^(?:import|export)(?! type)[^;]*? from '([.][^']+[.]tsx?)';/gmu,
    ))
      comesWith(join(dirname(path), to), found);
    return found;
  }

  test('does not bring what only later parts say', () => {
    const first = comesWith(join('app', 'main.tsx'));
    expect(first).toContain(join('i18n', 'words.ts'));
    expect(first).not.toContain(join('i18n', 'whole.ts'));
    expect(comesWith(join('features', 'library', 'files', 'FilesDialog.tsx'))).toContain(
      join('i18n', 'whole.ts'),
    );
  });

  test('says less than half of all', () => {
    const first = firstKeys();
    const english = messagesOf(readTree('en'));
    const isFirst = ([key]: readonly [string, string]): boolean =>
      first.some((one) => one === key || key.startsWith(`${one}.`));
    expect(first).toContain('stop.button');
    expect(english.filter(isFirst).length).toBeLessThan(english.length / 2);
  });
});
