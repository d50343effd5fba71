import { createElement } from 'react';
import { renderToStaticMarkup } from 'react-dom/server';
import { afterEach, expect, test, vi } from 'vitest';
import { words } from '../../i18n/whole.ts';
import { AddressNotes } from './PeopleView.tsx';

afterEach(() => void vi.unstubAllGlobals());

/** What is said on a page that was opened at such an address. */
function notesAt(isSecureContext: boolean, overheard: boolean): readonly string[] {
  vi.stubGlobal('window', { isSecureContext });
  const page = renderToStaticMarkup(createElement(AddressNotes, { overheard }));
  return page
    .replaceAll(/<p[^>]*>/g, '')
    .split('</p>')
    .slice(0, -1);
}

const { overheard, insecure } = words.people;

test('a page over plain http says who can listen, what a browser keeps back there and what works', () => {
  expect(notesAt(false, true)).toEqual([overheard, insecure]);
  for (const named of ['USB', 'game pad', 'clipboard', 'Stop']) expect(insecure).toContain(named);
});

test('each of them is said only where it holds', () => {
  expect(notesAt(true, true)).toEqual([overheard]);
  expect(notesAt(false, false)).toEqual([insecure]);
  expect(notesAt(true, false)).toEqual([]);
});
