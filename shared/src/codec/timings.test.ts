// shared/protocol/timings.json: each value says where it comes from, and no constant of behaviour stands in both languages
// instead. The gateway's reader (backend/servodeck/protocol/timings.py) knows each value by name, or does not start.

import { readFileSync, readdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { describe, expect, test } from 'vitest';
import timings from '../../protocol/timings.json' with { type: 'json' };

const root = resolve(import.meta.dirname, '../../..');
const { why: _, ...sections } = timings;

describe.each(Object.entries(sections))('%s', (_name, { why, ...values }) => {
  test('each value has its unit in its name, or counts, and says why', () => {
    expect(Object.keys(why)).toEqual(Object.keys(values));
    for (const value of Object.values<unknown>(values).flat()) expect(value).toBeTypeOf('number');
  });
});

/** How a packet is built: README.md of shared/protocol tells it, the vectors hold both codecs to it. */
const PACKET_FORMAT = ['ALL_GROUPS', 'COMMAND_AT', 'HEADER', 'HEAD_SIZE', 'MAX_LENGTH', 'MIN_LENGTH'];
/** Of one language each, whatever they are called. */
const UNRELATED = ['NO', 'VERSION', 'WAIT'];

const constant =
  /^(?:export )?(?:const )?_?([A-Z][A-Z0-9_]*)(?:: [^=\n]+)? = (-?[\d_.]+(?:x[\da-f]+)?(?: \* [\d_]+)*)(?:;| |$)/gim;

/** Constants that a module gives a number of its own: `NAME value`, in milliseconds whatever their unit is. */
function numbersIn(folder: string, isSource: RegExp): readonly string[] {
  const files = readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' }).filter((file) =>
    isSource.test(file),
  );
  const texts = files.map((file) => readFileSync(join(root, folder, file), 'utf8'));
  return texts.flatMap((text) =>
    [...text.matchAll(constant)].map(([, name = '', written = '']) => {
      const factors = written.split('*').map((factor) => Number(factor.replaceAll('_', '')));
      const value = factors.reduce((product, factor) => product * factor, name.endsWith('_S') ? 1000 : 1);
      return `${name.replace(/_(MS|S)$/, '')} ${value}`;
    }),
  );
}

test('no constant of behaviour stands in both languages', () => {
  const source = /^(?!.*(simulator|faults)[/\\]).*(?<!\.test|UnderTest|rig|\.d|\.generated)\.tsx?$/;
  const page = new Set([...numbersIn('shared/src', source), ...numbersIn('frontend/src', source)]);
  const both = numbersIn('backend/servodeck', /\.py$/).filter((constant) => page.has(constant));
  const mayBe = [...PACKET_FORMAT, ...UNRELATED];
  expect(both.filter((one) => !mayBe.some((name) => one.startsWith(`${name} `)))).toEqual([]);
});
