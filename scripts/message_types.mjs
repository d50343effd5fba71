// `npm run messages`: TypeScript types of the WebSocket's messages, made from the gateway's own models. `--check` writes
// nothing and fails when the committed file says something else.

import { readFileSync, writeFileSync } from 'node:fs';
import { compile } from 'json-schema-to-typescript';
import { python } from './python.mjs';
import { SetupProblem, at, main, mustRun, say } from './steps.mjs';

const target = 'frontend/src/transports/messages.generated.ts';
const banner =
  "// Made from the gateway's models by `npm run messages`; a check fails when the two differ. Change " +
  'backend/servodeck/messages.py instead.';

/** @returns {Promise<string>} */
async function generate() {
  const env = { PYTHONPATH: at('backend') };
  const schema = await mustRun('read the message models', python, ['-m', 'servodeck.messages'], { env });
  /** @type {{$defs: Record<string, object>}} */
  const { $defs } = JSON.parse(schema);
  const eitherWay = { oneOf: [{ $ref: '#/$defs/ClientMessage' }, { $ref: '#/$defs/GatewayMessage' }], $defs };
  return compile(eitherWay, 'Message', {
    bannerComment: banner,
    additionalProperties: false,
    unreachableDefinitions: true,
    style: { printWidth: 110, singleQuote: true },
  });
}

function committed() {
  try {
    return readFileSync(at(target), 'utf8').replaceAll('\r\n', '\n');
  } catch {
    return '';
  }
}

await main(async () => {
  const fresh = await generate();
  if (!process.argv.includes('--check')) {
    writeFileSync(at(target), fresh);
    say(`Wrote ${target}`);
  } else if (fresh !== committed()) {
    throw new SetupProblem(`${target} is not what the gateway's models say. Run: npm run messages`);
  }
  return 0;
});
