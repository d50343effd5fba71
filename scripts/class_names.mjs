// Class names in the built page: `c4z` instead of `_name_hash_line`, and none for a class that nothing reads. So short a name is
// written where it is used, which spares the first load a table of names for each style sheet.

import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';

const CLASS = /\.([a-z][\w-]*)/gi;
const IMPORT = /import (\w+) from ('[^']+\.module\.css')/g;
/** What may be exported under its own name. */
const PLAIN = /^(?!(case|class|default|delete|export|for|if|import|in|new|switch|this|with)$)\w+$/;

/** The same names for the same sheets, in whichever order they are read. @param {string} folder */
function namesIn(folder) {
  const names = new Map();
  for (const sheet of readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(isSheet).sort()) {
    const file = path.join(folder, sheet);
    for (const [, name] of readFileSync(file, 'utf8').matchAll(CLASS)) {
      const key = keyOf(file, name);
      if (!names.has(key)) names.set(key, `c${names.size.toString(36)}`);
    }
  }
  return names;
}

/** @param {string} name */
const isSheet = (name) => name.endsWith('.module.css');
/** @param {string} file @param {string | undefined} name */
const keyOf = (file, name) => `${path.resolve(file)} ${name}`;

/** @param {string} folder @returns {import('vite').Plugin} */
export function shortClassNames(folder) {
  /** @type {Map<string, string>} */
  const names = namesIn(folder);
  return {
    name: 'short-class-names',
    apply: 'build',
    enforce: 'pre',
    config: () => ({
      css: {
        modules: {
          generateScopedName(name, file) {
            const short = names.get(keyOf(file.replace(/\?.*/, ''), name));
            if (short === undefined || !PLAIN.test(name))
              throw new Error(`no short name for .${name} in ${file}`);
            return short;
          },
        },
      },
    }),
    // A sheet’s names one by one: its default export would be a table of all of them.
    transform: (code, id) =>
      /\.tsx?$/.test(id) && code.includes('.module.css')
        ? code.replace(IMPORT, 'import * as $1 from $2')
        : null,
  };
}
