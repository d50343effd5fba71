// The page's words: reads frontend/src/i18n/*.json (ICU MessageFormat) and makes of them the modules that the page loads and the
// types of its keys. Knows nothing of what a message is about.

import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { TYPE, parse } from '@formatjs/icu-messageformat-parser';
import { at } from './steps.mjs';

/** @typedef {import('@formatjs/icu-messageformat-parser').MessageFormatElement} Element */
/** @typedef {{ [key: string]: string | Tree }} Tree */
/** @typedef {'string' | 'number' | 'boolean'} ValueType */

const FOLDER = at('frontend/src/i18n');
const SOURCES = at('frontend/src');

/** What a number or a date may be shown as: the style in the message, the formatter of i18n/numbers.ts. */
const FORMATTERS = {
  '': 'formatCount',
  '::group-off': 'formatWhole',
  percent: 'formatPercent',
  milliseconds: 'formatMs',
  seconds: 'formatSeconds',
  secondsUp: 'formatSecondsUp',
  roughly: 'formatRoughly',
  minutes: 'formatMinutes',
  volts: 'formatVolts',
};

/** @param {string} language @returns {Tree} */
export function readTree(language) {
  return /** @type {Tree} */ (JSON.parse(readFileSync(path.join(FOLDER, `${language}.json`), 'utf8')));
}

/** @returns {string[]} */
export function languages() {
  return readdirSync(FOLDER)
    .filter((name) => name.endsWith('.json'))
    .map((name) => name.slice(0, -'.json'.length));
}

/** Every message with its key, `connect.title`. @param {Tree} tree @returns {[string, string][]} */
export function messagesOf(tree, within = '') {
  return Object.entries(tree).flatMap(([key, inner]) => {
    const whole = within === '' ? key : `${within}.${key}`;
    return typeof inner === 'string' ? [[whole, inner]] : messagesOf(inner, whole);
  });
}

/** The values that a message takes, in the order in which it names them. @param {string} message */
export function valuesOf(message) {
  /** @type {Map<string, ValueType>} */
  const values = new Map();
  /** @param {Element[]} elements */
  const walk = (elements) => {
    for (const element of elements) {
      if (element.type === TYPE.literal || element.type === TYPE.pound) continue;
      const type = typeOf(element);
      if (values.get(element.value) !== 'string') values.set(element.value, type);
      if ('options' in element) for (const option of Object.values(element.options)) walk(option.value);
    }
  };
  walk(elementsOf(message));
  return values;
}

/** @param {string} message @returns {Element[]} */
function elementsOf(message) {
  return naming(message, () => parse(message, { requiresOtherClause: true }));
}

/** Runs it; what goes wrong names the message. @template T @param {string} message @param {() => T} run @returns {T} */
function naming(message, run) {
  try {
    return run();
  } catch (error) {
    throw new Error(`“${message}”: ${error instanceof Error ? error.message : String(error)}`, {
      cause: error,
    });
  }
}

/** @param {Element} element @returns {ValueType} */
function typeOf(element) {
  switch (element.type) {
    case TYPE.argument:
      return 'string';
    case TYPE.number:
    case TYPE.date:
    case TYPE.time:
    case TYPE.plural:
      return 'number';
    case TYPE.select:
      return isYesOrNo(element) ? 'boolean' : 'string';
    default:
      throw new Error('Elements inside of messages are not made yet.');
  }
}

/** @param {Extract<Element, { type: TYPE.select }>} element */
function isYesOrNo({ options }) {
  return Object.keys(options).join() === 'true,other';
}

/** @param {Tree} tree */
export function typesText(tree) {
  return [
    '// Made from en.json by `npm run messages`; a check fails when the two differ. Change en.json instead.',
    '',
    `export interface Messages ${treeType(tree, '')}`,
    '',
  ].join('\n');
}

/** @param {Tree} tree @param {string} indent @returns {string} */
function treeType(tree, indent) {
  const deeper = `${indent}  `;
  const lines = Object.entries(tree).map(
    ([key, inner]) =>
      `${deeper}readonly ${name(key)}: ${typeof inner === 'string' ? messageType(inner) : treeType(inner, deeper)};`,
  );
  return ['{', ...lines, `${indent}}`].join('\n');
}

/** @param {string} message */
function messageType(message) {
  const values = [...valuesOf(message)].map(([value, type]) => `readonly ${name(value)}: ${type}`);
  return values.length === 0 ? 'string' : `(values: { ${values.join('; ')} }) => string`;
}

/**
 * The messages as a module that exports `words`; of those that stand in another module, only what is around them.
 *
 * @param {Tree} tree
 * @param {{ isWanted?: (key: string) => boolean, first?: string }} [options] `first`: the module that has the others
 */
export function moduleText(tree, { isWanted = () => true, first } = {}) {
  /** @type {Set<string>} */
  const used = new Set();

  /** @param {Tree} inner @param {string} within @param {string} others @returns {string} */
  const object = (inner, within, others) => {
    const parts = Object.entries(inner).flatMap(([key, value]) => {
      const whole = within === '' ? key : `${within}.${key}`;
      if (typeof value === 'string')
        return isWanted(whole) ? [`${name(key)}: ${functionText(value, used)}`] : [];
      const wanted = messagesOf(value, whole).filter(([one]) => isWanted(one)).length;
      if (wanted === 0) return [];
      const isSplit = others !== '' && wanted < messagesOf(value).length;
      return [`${name(key)}: ${object(value, whole, isSplit ? `${others}.${key}` : '')}`];
    });
    return `{ ${[...(others === '' ? [] : [`...${others}`]), ...parts].join(', ')} }`;
  };

  const body = object(tree, '', first === undefined ? '' : 'first');
  return [
    first === undefined
      ? `import { numbersIn } from '${FOLDER}/numbers.ts';\nconst numbers = numbersIn(${JSON.stringify(tree.locale)});`
      : `import { words as first } from '${first}';\nconst { numbers } = first;`,
    `const { ${[...used].sort().join(', ')} } = numbers;`,
    `export const words = ${body.replace('{', '{ numbers,')};`,
  ].join('\n');
}

/** A message that takes no values is its text. @param {string} message @param {Set<string>} used */
function functionText(message, used) {
  const text = naming(message, () => literal(partsOf(elementsOf(message), used, '')));
  return valuesOf(message).size === 0 ? text : `(v) => ${text}`;
}

/**
 * What a template literal of these elements is made of: characters, and expressions in their braces.
 *
 * @param {Element[]} elements
 * @param {Set<string>} used
 * @param {string} counted the value that `#` stands for
 * @returns {string[]}
 */
function partsOf(elements, used, counted) {
  return elements.flatMap((element) => {
    switch (element.type) {
      case TYPE.literal:
        return Array.from(element.value, (character) =>
          /[\\`$]/u.test(character) ? `\\${character}` : character,
        );
      case TYPE.argument:
        return [inBraces(`v.${element.value}`)];
      case TYPE.pound:
        return [inBraces(call('formatCount', counted, used))];
      case TYPE.number:
      case TYPE.date:
      case TYPE.time:
        return [inBraces(call(formatter(element), `v.${element.value}`, used))];
      case TYPE.select: {
        const value = `v.${element.value}`;
        const isYes = isYesOrNo(element);
        const branches = branchesOf(element, (inner) => partsOf(inner, used, counted));
        return choice(branches, (key) => (isYes ? value : `${value} === '${key}'`));
      }
      case TYPE.plural: {
        if (element.offset !== 0) throw new Error('Offsets of plurals are not made yet.');
        const value = `v.${element.value}`;
        const branches = branchesOf(element, (inner) => partsOf(inner, used, value));
        return choice(branches, (key) =>
          key.startsWith('=')
            ? `${value} === ${key.slice(1)}`
            : `${call('plural', value, used)} === '${key}'`,
        );
      }
      default:
        throw new Error('Elements inside of messages are not made yet.');
    }
  });
}

/** @param {string[]} parts */
function literal(parts) {
  const [only = ''] = parts;
  return parts.length === 1 && only.startsWith('${') ? `(${only.slice(2, -1)})` : `\`${parts.join('')}\``;
}

/** @param {string} expression */
function inBraces(expression) {
  return `\${${expression}}`;
}

/** @typedef {{ key: string, parts: string[] }} Branch */

/**
 * @param {{ options: Record<string, { value: Element[] }> }} element
 * @param {(inner: Element[]) => string[]} parts
 * @returns {Branch[]}
 */
function branchesOf({ options }, parts) {
  return Object.entries(options).map(([key, { value }]) => ({ key, parts: parts(value) }));
}

/** What all branches begin or end with stands before or behind the choice. @param {Branch[]} branches @param {(key: string) => string} test */
function choice(branches, test) {
  const before = sharedParts(branches, (parts) => parts.shift(), 0);
  const after = sharedParts(branches, (parts) => parts.pop(), -1).reverse();
  const others = branches.filter(({ key }) => key !== 'other');
  const last = branches.find(({ key }) => key === 'other')?.parts ?? [];
  const tests = others.map(({ key, parts }) => `${test(key)} ? ${literal(parts)} : `);
  const chosen = others.length === 0 ? [] : [inBraces(`${tests.join('')}${literal(last)}`)];
  return [...before, ...chosen, ...after];
}

/** Takes them from all branches. @param {Branch[]} branches @param {(parts: string[]) => unknown} take @param {number} at */
function sharedParts(branches, take, at) {
  const shared = [];
  for (;;) {
    const [first, ...others] = branches.map(({ parts }) => parts.at(at));
    if (first === undefined || others.some((other) => other !== first)) return shared;
    branches.forEach(({ parts }) => take(parts));
    shared.push(first);
  }
}

/** @param {Extract<Element, { type: TYPE.number | TYPE.date | TYPE.time }>} element */
function formatter({ value, style }) {
  const named = typeof style === 'object' && style !== null ? `::${skeleton(style)}` : (style ?? '');
  const found = Object.entries(FORMATTERS).find(([one]) => one === named)?.[1];
  if (found === undefined) throw new Error(`No formatter shows “${value}” as “${named}”.`);
  return found;
}

/** @param {object} style */
function skeleton(style) {
  if (!('tokens' in style)) return '';
  return /** @type {{ stem: string }[]} */ (style.tokens).map(({ stem }) => stem).join(' ');
}

/** @param {string} formatter @param {string} value @param {Set<string>} used */
function call(formatter, value, used) {
  used.add(formatter);
  return `${formatter}(${value})`;
}

/** @param {string} key */
function name(key) {
  return /^[A-Za-z_]\w*$/u.test(key) ? key : `'${key}'`;
}

const READS_FIRST = /import \{[^}]*\bwords\b[^}]*\} from '[./]*(?:\/i18n)?\/words\.ts'/u;

/**
 * The keys, or their beginnings, that the modules of the first load read: those that import i18n/words.ts.
 *
 * @returns {string[]}
 */
export function firstKeys() {
  /** @type {Set<string>} */
  const found = new Set();
  for (const file of readdirSync(SOURCES, { recursive: true, encoding: 'utf8' })) {
    if (!/\.tsx?$/u.test(file) || /\.test\.tsx?$|^app.gallery\b/u.test(file)) continue;
    const text = readFileSync(path.join(SOURCES, file), 'utf8');
    if (READS_FIRST.test(text)) for (const key of keysIn(text, file)) found.add(key);
  }
  return [...found];
}

/** @param {string} source @param {string} file */
function keysIn(source, file) {
  const text = source.replaceAll(/\/\*.*?\*\/|^import .*?;$/gmsu, '').replaceAll(/^\s*\/\/.*$/gmu, '');
  return [...text.matchAll(/(?<![\w.'$-])words(?![\w'-]|\s*=)((?:\s*\.\s*\w+)*)/gu)].map(([, chain = '']) => {
    const key = chain.replaceAll(/\s/gu, '').slice(1);
    if (key === '') throw new Error(`${file}: write out which words are read, as words.group.key.`);
    return key;
  });
}

/** Whether a message belongs to the first load. @returns {(key: string) => boolean} */
function firstLoad() {
  const first = firstKeys();
  return (key) => first.some((one) => one === key || one.startsWith(`${key}.`) || key.startsWith(`${one}.`));
}

/** Vite's part: `virtual:words/en/first` with what the first load says, `virtual:words/en/rest`, and other languages whole. */
export function words() {
  const prefix = 'virtual:words/';
  return {
    name: 'words',
    /** @param {string} id */
    resolveId: (id) => (id.startsWith(prefix) ? `\0${id}` : null),
    /** @this {{ addWatchFile(file: string): void }} @param {string} id */
    load(id) {
      if (!id.startsWith(`\0${prefix}`)) return null;
      const [language = '', part] = id.slice(prefix.length + 1).split('/');
      this.addWatchFile(path.join(FOLDER, `${language}.json`));
      const tree = readTree(language);
      if (part === undefined) return moduleText(tree);
      const isFirst = firstLoad();
      return part === 'first'
        ? moduleText(tree, { isWanted: isFirst })
        : moduleText(tree, { isWanted: (key) => !isFirst(key), first: `${prefix}${language}/first` });
    },
  };
}
