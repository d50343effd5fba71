import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { afterEach, beforeEach, expect, test } from 'vitest';
import { folderOf, textOf } from './licences.mjs';

let root = '';
beforeEach(() => {
  root = mkdtempSync(path.join(tmpdir(), 'licences-'));
});
afterEach(() => rmSync(root, { recursive: true }));

function installed(name: string, license: string | undefined, text?: string): string {
  const folder = path.join(root, 'node_modules', name);
  mkdirSync(folder, { recursive: true });
  writeFileSync(path.join(folder, 'package.json'), JSON.stringify({ name, version: '1.2.3', license }));
  if (text !== undefined) writeFileSync(path.join(folder, 'LICENSE.md'), text);
  return folder;
}

test('a module belongs to the innermost package, and our own to none', () => {
  expect(folderOf('/a/node_modules/three/build/three.js')).toBe('/a/node_modules/three');
  expect(folderOf('\0/a/node_modules/@x/y/index.css?inline')).toBe('/a/node_modules/@x/y');
  expect(folderOf('/a/node_modules/b/node_modules/c/d.js')).toBe('/a/node_modules/b/node_modules/c');
  expect(folderOf('/a/frontend/src/app/main.tsx')).toBeNull();
});

test('each package is named once with its text', () => {
  const [one, two] = [
    installed('one', 'MIT', 'Text of one.'),
    installed('@a/two', 'OFL-1.1', 'Text of two.'),
  ];
  const text = textOf([one, two]);
  expect(text).toContain('one 1.2.3 (MIT)');
  expect(text.indexOf('Text of two.')).toBeLessThan(text.indexOf('Text of one.'));
  expect(textOf([one, two], text)).toBe(text);
});

test('a package without a text, or under another licence, is an error that names it', () => {
  expect(() => textOf([installed('silent', 'MIT')])).toThrow('silent has no licence text');
  expect(() => textOf([installed('other', 'GPL-3.0-only', 'x')])).toThrow(
    'other has the licence GPL-3.0-only',
  );
  expect(() => textOf([installed('none', undefined, 'x')])).toThrow('none has the licence undefined');
});
