import fc from 'fast-check';
import { is } from 'valibot';
import { expect, test } from 'vitest';
import { emptyGroup, groupSchema } from '../group/group.ts';
import { tagsFromText, tagsToText } from './libraryText.ts';

test.each([
  ['', []],
  [' greeting ,, show,greeting', ['greeting', 'show']],
  ['问候，表演、手', ['问候', '表演', '手']],
])('%j is read as %j', (text, tags) => {
  expect(tagsFromText(text)).toEqual(tags);
});

test('whatever is written is fit for a group and stays what it is', () => {
  fc.assert(
    fc.property(fc.string({ unit: fc.constantFrom(',', ' ', 'a', 'b', '，'), maxLength: 400 }), (text) => {
      const tags = tagsFromText(text);
      expect(is(groupSchema, { ...emptyGroup('', 'us'), tags })).toBe(true);
      expect(tagsFromText(tagsToText(tags))).toEqual(tags);
    }),
  );
});
