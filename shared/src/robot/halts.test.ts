// shared/protocol/vectors/halts.json: what a STOP would hold and what not, in generated histories; the gateway's estimate
// answers the same (backend/tests). After a change of the model: `npx vitest run shared/src/robot/halts.test.ts -u`.

import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { generateHaltHistories, replayHalts, type HaltHistory } from './haltsUnderTest.ts';

const FILE = new URL('../../protocol/vectors/halts.json', import.meta.url);

/** One event a line. */
function written(histories: readonly HaltHistory[]): string {
  const lines = histories.map(({ family, events }) => {
    const list = events.map((event) => `  ${JSON.stringify(event)}`).join(',\n');
    return `{"family": "${family}", "events": [\n${list}\n]}`;
  });
  return `[${lines.join(',\n')}]\n`;
}

test('the file is what the generator gives', async () => {
  await expect(written(await generateHaltHistories())).toMatchFileSnapshot(FILE.pathname);
}, 60_000);

test('the estimate says to each halt what the file says', () => {
  const histories = JSON.parse(readFileSync(FILE, 'utf8')) as readonly HaltHistory[];
  for (const history of histories) expect(replayHalts(history)).toEqual(history.events);
});
