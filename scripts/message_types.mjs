// `npm run messages`: TypeScript types of what page and gateway say to each other, made from the gateway's own models, and of what the
// page says to people, made from its English words. `--check` writes nothing and fails when a committed file says something else.

import { readFileSync, writeFileSync } from 'node:fs';
import { compile } from 'json-schema-to-typescript';
import { python } from './python.mjs';
import { SetupProblem, at, main, mustRun, say } from './steps.mjs';
import { readTree, typesText } from './words.mjs';

const TARGETS = [
  { module: 'events', target: 'frontend/src/robot/links/messages.generated.ts' },
  { module: 'api.library', target: 'frontend/src/features/library/library.generated.ts' },
  { module: 'api.people', target: 'frontend/src/robot/people.generated.ts' },
];

/** @param {string} module @returns {Promise<string>} */
async function generate(module) {
  const env = { PYTHONPATH: at('backend') };
  const schema = await mustRun('read the message models', python, ['-m', `servodeck.${module}`], { env });
  /** @type {{title: string, version?: number}} */
  const parsed = JSON.parse(schema);
  const types = await compile(parsed, parsed.title, {
    bannerComment:
      "// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change " +
      `backend/servodeck/${module.replaceAll('.', '/')}.py instead.`,
    additionalProperties: false,
    ignoreMinAndMaxItems: true,
    unreachableDefinitions: true,
    style: { printWidth: 110, singleQuote: true },
  });
  if (parsed.version === undefined) return types;
  return `${types}/** Of these messages. */\nexport const PROTOCOL = ${parsed.version};\n`;
}

/** @param {string} target */
function committed(target) {
  try {
    return readFileSync(at(target), 'utf8').replaceAll('\r\n', '\n');
  } catch {
    return '';
  }
}

/** @param {boolean} mayWrite @param {string} target @param {string} fresh @param {string} source */
function bring(mayWrite, target, fresh, source) {
  if (mayWrite) {
    writeFileSync(at(target), fresh);
    say(`Wrote ${target}`);
  } else if (fresh !== committed(target)) {
    throw new SetupProblem(`${target} is not what ${source} say. Run: npm run messages`);
  }
}

await main(async () => {
  const mayWrite = !process.argv.includes('--check');
  bring(mayWrite, 'frontend/src/i18n/words.generated.ts', typesText(readTree('en')), 'the English words');
  for (const { module, target } of TARGETS)
    bring(mayWrite, target, await generate(module), "the gateway's models");
  return 0;
});
