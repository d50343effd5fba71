// The client says the same words as the one for Python: shared/protocol/client.json, which backend/tests/test_client_twins.py reads, too.

import { readFileSync } from 'node:fs';
import ts from 'typescript';
import { expect, test } from 'vitest';
import words from '../../protocol/client.json' with { type: 'json' };

const sourceOf = (name: string): ts.SourceFile =>
  ts.createSourceFile(
    name,
    readFileSync(`${import.meta.dirname}/${name}`, 'utf8'),
    ts.ScriptTarget.Latest,
    true,
  );

const servodeck = sourceOf('servodeck.ts');
const members: readonly ts.ClassElement[] = servodeck.statements.find(ts.isClassDeclaration)?.members ?? [];

/** Of this language alone: Python cancels its task, and refuses unknown options by itself. */
const OF_THIS_LANGUAGE = ['signal', 'unknown'];

function wordsOf({ parameters }: ts.SignatureDeclarationBase) {
  const options = parameters.map(({ name }) => name).find(ts.isObjectBindingPattern)?.elements ?? [];
  return {
    arguments: parameters.flatMap(({ name }) => (ts.isIdentifier(name) ? [name.text] : [])),
    options: options.map(({ name }) => name.getText()).filter((name) => !OF_THIS_LANGUAGE.includes(name)),
  };
}

test('each method takes the arguments and options of its twin', () => {
  const methods = members.filter(ts.isMethodDeclaration).filter(({ name }) => ts.isIdentifier(name));
  expect(Object.fromEntries(methods.map((method) => [method.name.getText(), wordsOf(method)]))).toEqual(
    words.methods,
  );
  const opening = members.find(ts.isConstructorDeclaration);
  expect(opening && wordsOf(opening)).toEqual(words.opening);
});

test('values have the fields of their twins', () => {
  const values = sourceOf('values.ts').statements.filter(ts.isInterfaceDeclaration);
  const shown = values.filter(({ name }) => name.text in words.values);
  const fieldsOf = (value: ts.InterfaceDeclaration): unknown[] => [
    value.name.text,
    value.members.map(({ name }) => name?.getText()),
  ];
  expect(Object.fromEntries(shown.map(fieldsOf))).toEqual(words.values);
});

test('the errors have the names of their twins', async () => {
  expect(Object.keys(await import('./errors.ts')).filter((name) => name.endsWith('Error'))).toEqual(
    words.errors,
  );
});
