// The linter's rules that are this project's own: shapes of code that are not written here, and what is written instead. A shape
// is a selector of syntax, as ESLint has them.

const WORDS_AT_LOAD = 'Words are read while drawing, not when a module is loaded: their language changes.';

/** @type {Record<string, { selectors: string[], message: string }>} */
const shapes = {
  'no-barrel': {
    selectors: ['ExportAllDeclaration'],
    message: 'No barrels: import from the module that owns the name.',
  },
  'named-exports': {
    selectors: ['ExportDefaultDeclaration'],
    message: 'Named exports only (tool configs excepted).',
  },
  'no-enum': { selectors: ['TSEnumDeclaration'], message: 'A const object and a union of its values.' },
  'no-i-prefix': {
    selectors: [':matches(TSInterfaceDeclaration, TSTypeAliasDeclaration)[id.name=/^I[A-Z][a-z]/]'],
    message: 'No `I` prefix.',
  },
  'telling-names': {
    selectors: [':matches(ClassDeclaration, TSInterfaceDeclaration)[id.name=/(Manager|Helper|Utils?)$/]'],
    message: 'Name it after what it knows or does.',
  },
  'words-while-drawing': {
    selectors: [
      'Identifier[name="words"]:not(:function *, ImportSpecifier *)',
      'CallExpression[callee.property.name=/^(map|flatMap|reduce|from)$/]:not(:function *) Identifier[name="words"]',
    ],
    message: WORDS_AT_LOAD,
  },
  'override-inside': {
    selectors: ['Program > ExpressionStatement > CallExpression[callee.property.name="override"]'],
    message: 'It would hold for other files, too: `const test = base.extend(…)`, or inside of a `describe`.',
  },
};

/** @typedef {{ report(found: { node: unknown, message: string }): void }} Context */

export default {
  meta: { name: 'house' },
  rules: Object.fromEntries(
    Object.entries(shapes).map(([name, { selectors, message }]) => [
      name,
      {
        /** @param {Context} context */
        create: (context) =>
          Object.fromEntries(
            selectors.map((selector) => [
              selector,
              (/** @type {unknown} */ node) => context.report({ node, message }),
            ]),
          ),
      },
    ]),
  ),
};
