// `npm run messages`: TypeScript types of what page and gateway say to each other, made from the gateway's own models, and of what the
// page says to people, made from its English words. `--check` writes nothing and fails when a committed file says something else.

import { readFileSync, writeFileSync } from 'node:fs';
import { compile } from 'json-schema-to-typescript';
import openapiTypes, { astToString } from 'openapi-typescript';
import { format } from 'oxfmt';
import { python } from './python.mjs';
import { SetupProblem, at, main, mustRun, say } from './steps.mjs';
import { readTree, typesText } from './words.mjs';

const MESSAGES = 'shared/src/client/messages.generated.ts';
const HTTP = 'shared/src/client/http.generated.ts';
const DRIVE = 'frontend/src/fleet/drive.generated.ts';

/** @typedef {{ content?: Record<string, { example?: unknown }> }} Part */
/** @typedef {{ description?: string, security?: unknown, requestBody?: Part, responses: Record<string, Part> }} Operation */
/** @typedef {import('openapi-typescript').OpenAPI3 & { paths: Record<string, Record<string, Operation>> }} Description */

/** @param {string} module */
function printedBy(module) {
  const env = { PYTHONPATH: at('backend') };
  return mustRun('read the gateway’s models', python, ['-m', module], { env });
}

/** @param {string} source */
const banner = (source) =>
  "// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change " +
  `${source} instead.`;

/** The types of the schema that a module prints, and its version. @param {string} module */
async function messagesOf(module) {
  /** @type {{ title: string, version?: number }} */
  const schema = JSON.parse(await printedBy(module));
  const types = await compile(schema, schema.title, {
    bannerComment: banner(`backend/${module.replaceAll('.', '/')}.py`),
    additionalProperties: false,
    ignoreMinAndMaxItems: true,
    unreachableDefinitions: true,
    style: { printWidth: 110, singleQuote: true },
  });
  return { types, version: schema.version };
}

async function messages() {
  const { types, version } = await messagesOf('servodeck.events');
  return `${types}/** Of these messages. */\nexport const PROTOCOL = ${version};\n`;
}

/** Routes, what they take and what they answer; every refusal is the same `{code, detail}`, and examples are for people. */
async function http() {
  /** @type {Description} */
  const description = JSON.parse(await printedBy('servodeck.api.app'));
  for (const operation of Object.values(description.paths).flatMap((path) => Object.values(path))) {
    delete operation.description;
    delete operation.security;
    const taken = Object.entries(operation.responses).filter(([status]) => status.startsWith('2'));
    operation.responses = Object.fromEntries(taken);
    for (const part of [operation.requestBody, ...Object.values(operation.responses)])
      for (const body of Object.values(part?.content ?? {})) delete body.example;
  }
  const types = astToString(
    await openapiTypes(description, {
      ...{ alphabetize: true, defaultNonNullable: false },
      ...{ rootTypes: true, rootTypesNoSchemaPrefix: true },
    }),
  );
  const source = banner('the routes of backend/servodeck/api');
  const { code } = await format(HTTP, `${source}\n\n${types}`, { printWidth: 110, singleQuote: true });
  return code;
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
  bring(mayWrite, MESSAGES, await messages(), "the gateway's models");
  const drive = await messagesOf('servodeck.fleet.drive_messages');
  bring(mayWrite, DRIVE, drive.types, "the gateway's models");
  bring(mayWrite, HTTP, await http(), "the gateway's routes");
  return 0;
});
