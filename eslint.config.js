// What the linter holds: typed rules for all TypeScript and for the scripts, React's rules for the page.

import js from '@eslint/js';
import reactHooks from 'eslint-plugin-react-hooks';
import { defineConfig, globalIgnores } from 'eslint/config';
import tseslint from 'typescript-eslint';

const house = {
  'no-warning-comments': ['error', { terms: ['todo', 'fixme', 'xxx', 'hack'] }],
  'no-restricted-syntax': [
    'error',
    {
      selector: 'ExportAllDeclaration',
      message: 'No barrels: import from the module that owns the name.',
    },
    {
      selector: 'ExportDefaultDeclaration',
      message: 'Named exports only (tool configs excepted).',
    },
    { selector: 'TSEnumDeclaration', message: 'A const object and a union of its values.' },
    {
      selector: ':matches(TSInterfaceDeclaration, TSTypeAliasDeclaration)[id.name=/^I[A-Z][a-z]/]',
      message: 'No `I` prefix.',
    },
    {
      selector: ':matches(ClassDeclaration, TSInterfaceDeclaration)[id.name=/(Manager|Helper|Utils?)$/]',
      message: 'Name it after what it knows or does.',
    },
  ],
  eqeqeq: 'error',
  'no-console': 'error',
  'prefer-const': 'error',
  'object-shorthand': 'error',
  'no-else-return': 'error',
};

const WORDS_AT_LOAD = 'Words are read while drawing, not when a module is loaded: their language changes.';

const typed = {
  // Objects here are closures: no method uses `this`, so taking one off its object is safe.
  '@typescript-eslint/unbound-method': 'off',
  '@typescript-eslint/consistent-type-definitions': 'off',
  '@typescript-eslint/consistent-type-imports': ['error', { fixStyle: 'inline-type-imports' }],
  '@typescript-eslint/no-confusing-void-expression': [
    'error',
    { ignoreArrowShorthand: true, ignoreVoidReturningFunctions: true },
  ],
  '@typescript-eslint/restrict-template-expressions': ['error', { allowNumber: true, allowBoolean: true }],
  '@typescript-eslint/switch-exhaustiveness-check': [
    'error',
    { considerDefaultExhaustiveForUnions: true, allowDefaultCaseForExhaustiveSwitch: true },
  ],
  '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_', varsIgnorePattern: '^_' }],
};

export default defineConfig(
  globalIgnores(['build/', 'backend/', 'test-results/', 'playwright-report/', '.venv/']),
  {
    files: ['**/*.{ts,tsx,mjs}'],
    extends: [
      js.configs.recommended,
      tseslint.configs.strictTypeChecked,
      tseslint.configs.stylisticTypeChecked,
    ],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: { ...house, ...typed },
  },
  {
    files: ['frontend/src/**/*.{ts,tsx}'],
    extends: [reactHooks.configs.flat.recommended],
    rules: { 'react-hooks/exhaustive-deps': 'error' },
  },
  {
    // The language changes under a running page, so a table that holds words is made where it is shown.
    files: ['frontend/src/**/*.{ts,tsx}'],
    ignores: ['**/*.test.ts', 'frontend/src/words/**'],
    rules: {
      'no-restricted-syntax': [
        ...house['no-restricted-syntax'],
        {
          selector: 'Identifier[name="words"]:not(:function *, ImportSpecifier *)',
          message: WORDS_AT_LOAD,
        },
        {
          selector:
            'CallExpression[callee.property.name=/^(map|flatMap|reduce|from)$/]:not(:function *) Identifier[name="words"]',
          message: WORDS_AT_LOAD,
        },
      ],
    },
  },
  {
    // One window, and one `test`, for all files of a worker.
    files: ['frontend/tests/**'],
    rules: {
      'no-restricted-syntax': [
        ...house['no-restricted-syntax'],
        {
          selector: 'Program > ExpressionStatement > CallExpression[callee.property.name="override"]',
          message:
            'It would hold for other files, too: `const test = base.extend(…)`, or inside of a `describe`.',
        },
      ],
    },
  },
  {
    // The type checker knows which names Node has; the linter does not see that a JSDoc cast names the type of an any.
    files: ['**/*.mjs'],
    rules: { 'no-undef': 'off', '@typescript-eslint/no-unsafe-assignment': 'off' },
  },
  {
    // The generator writes index signatures.
    files: ['**/*.generated.ts'],
    rules: { '@typescript-eslint/consistent-indexed-object-style': 'off' },
  },
  {
    // Programs for a terminal print.
    files: ['scripts/**', 'bench/**', 'shared/src/simulator/process.ts'],
    rules: { 'no-console': 'off' },
  },
  {
    files: ['*.config.ts'],
    rules: { 'no-restricted-syntax': 'off' },
  },
  {
    // A Playwright fixture that needs no other is written `async ({}, use) => …`.
    files: ['e2e/**'],
    rules: { 'no-empty-pattern': 'off' },
  },
  {
    // Tests read better when they state what must be there.
    files: ['**/*.test.{ts,tsx}', 'e2e/**'],
    rules: {
      '@typescript-eslint/no-non-null-assertion': 'off',
      '@typescript-eslint/no-empty-function': 'off',
      '@typescript-eslint/no-unnecessary-type-parameters': 'off',
      // Playwright reads from the pattern which fixtures a function wants; it may want none.
      'no-empty-pattern': ['error', { allowObjectPatternsAsParameters: true }],
    },
  },
);
