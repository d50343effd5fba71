// What every script shares: how it ends.

import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { expect, test } from 'vitest';

test('a script goes on when nobody reads any more what it says', async () => {
  const steps = JSON.stringify(join(import.meta.dirname, 'steps.mjs'));
  const script = `
    import { main, say } from ${steps};
    await main(async () => {
      for (let line = 0; line < 50; line += 1) {
        say('x'.repeat(10_000));
        await new Promise((resolve) => setTimeout(resolve, 1));
      }
      return 7;
    });`;
  const process = spawn('node', ['--input-type=module', '-e', script], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  process.stdout.destroy();
  expect(await once(process, 'exit')).toEqual([7, null]);
});
