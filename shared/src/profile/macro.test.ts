// Buttons as values: edits keep the page whole, each key belongs to one button, pages come back from their text.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { COLOURS } from '../document/schema.ts';
import {
  EMPTY_PAGE,
  keyOf,
  macroOf,
  type MacroPage,
  type MacroStep,
  macroPageFromText,
  macroPageToText,
} from './macro.ts';
import {
  addMacro,
  addStep,
  changeMacro,
  moveMacro,
  moveStep,
  removeMacro,
  removeStep,
  setStep,
} from './macroEdits.ts';

const HOME: MacroStep = { kind: 'pose', pose: 'home', durationMs: 1500 };
const SLOT: MacroStep = { kind: 'slot', slot: 5, times: 1 };
const WAIT: MacroStep = { kind: 'wait', waitMs: 500 };

const three = ['Wave', 'Bow', 'Sit'].reduce<MacroPage>(
  (page, name) => addMacro(page, name, [HOME]),
  EMPTY_PAGE,
);
const named = ({ macros }: MacroPage): readonly string[] => macros.map(({ name }) => name);
const stepsOf = (page: MacroPage): readonly MacroStep[] => macroOf(page, 1)!.steps;

describe('edits of the page', () => {
  test('buttons are added, moved and removed; neighbours differ in colour', () => {
    expect(named(moveMacro(three, 3, 0))).toEqual(['Sit', 'Wave', 'Bow']);
    expect(named(removeMacro(three, 2))).toEqual(['Wave', 'Sit']);
    expect(addMacro(removeMacro(three, 3), 'Nod', []).macros.at(-1)?.id).toBe(4);
    expect(three.macros.map(({ colour }) => colour)).toEqual(COLOURS.slice(0, 3));
  });

  test('a key goes from the button that had it to the one that gets it', () => {
    const keyed = changeMacro(changeMacro(three, 1, { key: 'w' }), 2, { key: 'w' });
    expect(keyed.macros.map(({ key }) => key)).toEqual([null, 'w', null]);
  });

  test('steps are added, changed, moved and removed', () => {
    const long = addStep(addStep(three, 1, SLOT), 1, WAIT);
    expect(stepsOf(long)).toEqual([HOME, SLOT, WAIT]);
    expect(stepsOf(moveStep(long, 1, 0, 2))).toEqual([SLOT, WAIT, HOME]);
    expect(stepsOf(setStep(long, 1, 1, WAIT))).toEqual([HOME, WAIT, WAIT]);
    expect(stepsOf(removeStep(long, 1, 0))).toEqual([SLOT, WAIT]);
  });

  test('what changes nothing is the very same page', () => {
    expect(changeMacro(three, 1, { name: 'Wave' })).toBe(three);
    expect(moveMacro(three, 1, 0)).toBe(three);
    expect(moveStep(three, 1, 0, 5)).toBe(three);
    expect(removeStep(three, 1, 5)).toBe(three);
    expect(removeMacro(three, 9)).toBe(three);
  });
});

test.each([
  ['W', 'w'],
  ['7', '7'],
  ['ß', 'ß'],
  [' ', null],
  ['Enter', null],
  ['Escape', null],
  ['F5', null],
])('the key %s is kept as %s', (pressed, kept) => expect(keyOf(pressed)).toBe(kept));

describe('a page as text', () => {
  const anyStep: fc.Arbitrary<MacroStep> = fc.oneof(
    fc.record({
      kind: fc.constant('pose' as const),
      pose: fc.oneof(fc.constantFrom('home' as const, 'rest' as const), fc.integer({ min: 1, max: 99 })),
      durationMs: fc.integer({ min: 0, max: 30_000 }),
    }),
    fc.record({
      kind: fc.constant('slot' as const),
      slot: fc.integer({ min: 0, max: 255 }),
      times: fc.integer({ min: 1, max: 255 }),
    }),
    fc.record({ kind: fc.constant('wait' as const), waitMs: fc.integer({ min: 100, max: 600_000 }) }),
  );

  test('is read back as it was', () => {
    fc.assert(
      fc.property(fc.array(fc.array(anyStep, { maxLength: 5 }), { maxLength: 8 }), (lists) => {
        const page = lists.reduce<MacroPage>((sum, steps) => addMacro(sum, 'Go', steps), EMPTY_PAGE);
        expect(macroPageFromText(macroPageToText(page))).toEqual({ value: page });
      }),
    );
  });

  const withKeys = (keys: readonly (string | null)[]): MacroPage => ({
    ...three,
    macros: three.macros.map((macro, index) => ({ ...macro, key: keys[index] ?? null })),
  });

  test.each([
    ['', 'notOurs', ''],
    [macroPageToText(withKeys([null, 'a', 'a'])), 'sameKey', 'A: Bow, Sit'],
    [macroPageToText(withKeys([null, 'A'])), 'badValue', 'content.macros.1.key'],
    [macroPageToText({ ...three, nextId: 3 }), 'sameNumber', ''],
    [macroPageToText(addStep(three, 1, { ...SLOT, times: 0 })), 'badValue', 'content.macros.0.steps.1.times'],
  ])('one that is damaged says where', (text, code, at) => {
    expect(macroPageFromText(text)).toEqual({ problem: { code, at } });
  });
});
