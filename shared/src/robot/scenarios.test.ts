// Every file of shared/protocol/scenarios, played on a session: it is what comes of its inputs. The gateway plays the same
// (backend/tests/test_scenarios.py). After a change of an input or of the rules: `npx vitest run shared/src/robot/scenarios.test.ts -u`.

import { readFileSync, readdirSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { played, type Scenario } from './scenariosUnderTest.ts';

const FOLDER = new URL('../../protocol/scenarios/', import.meta.url);

/** One event a line. */
function written(scenarios: readonly Scenario[]): string {
  const texts = scenarios.map(({ events, ...head }) => {
    const lines = events.map((event) => `  ${JSON.stringify(event)}`).join(',\n');
    return `{${JSON.stringify(head).slice(1, -1)}, "events": [\n${lines}\n]}`;
  });
  return `[${texts.join(',\n')}]\n`;
}

describe.each(readdirSync(FOLDER).filter((file) => file.endsWith('.json')))('%s', (file) => {
  test('is what comes of its inputs', async () => {
    const { pathname } = new URL(file, FOLDER);
    const scenarios = JSON.parse(readFileSync(pathname, 'utf8')) as readonly Scenario[];
    const all: Scenario[] = [];
    for (const scenario of scenarios) all.push(await played(scenario));
    await expect(written(all)).toMatchFileSnapshot(pathname);
  }, 60_000);
});
