// `npm run messages`: TypeScript types of what page and gateway say to each other, made from the gateway's own models.
// `--check` writes nothing and fails when a committed file says something else.

import { readFileSync, writeFileSync } from 'node:fs';
import { compile } from 'json-schema-to-typescript';
import { python } from './python.mjs';
import { SetupProblem, at, main, mustRun, say } from './steps.mjs';

const TARGETS = [
  { module: 'messages', target: 'frontend/src/transports/messages.generated.ts' },
  { module: 'library.library_messages', target: 'frontend/src/keepers/library.generated.ts' },
  { module: 'web.people_messages', target: 'frontend/src/stores/people/people.generated.ts' },
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

/** @param {boolean} mayWrite @param {typeof TARGETS[number]} made */
async function bring(mayWrite, { module, target }) {
  const fresh = await generate(module);
  if (mayWrite) {
    writeFileSync(at(target), fresh);
    say(`Wrote ${target}`);
  } else if (fresh !== committed(target)) {
    throw new SetupProblem(`${target} is not what the gateway's models say. Run: npm run messages`);
  }
}

await main(async () => {
  const mayWrite = !process.argv.includes('--check');
  for (const made of TARGETS) await bring(mayWrite, made);
  return 0;
});
