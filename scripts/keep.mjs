// `npm run keep -- NAME`: writes what people have of the present version into e2e/kept/NAME, for the tests of every later one.
// What is there already is never written again.

import { existsSync, rmSync } from 'node:fs';
import { brokerForTests, browserForTests } from './browser.mjs';
import { python } from './python.mjs';
import { setUp } from './setup.mjs';
import { at, main, mustRun, SetupProblem } from './steps.mjs';

await main(async () => {
  const [name = ''] = process.argv.slice(2);
  if (!/^[\w.-]+$/.test(name)) throw new SetupProblem('Name the folder, for example: npm run keep -- 2');
  const folder = `e2e/kept/${name}`;
  if (existsSync(at(folder)))
    throw new SetupProblem(`${folder} is there already, and people have such files.`);
  await setUp();
  await browserForTests();
  await brokerForTests();
  try {
    const journeys = ['node_modules/@playwright/test/cli.js', 'test', '--project', 'keep'];
    await mustRun('use the product', process.execPath, journeys, { env: { KEEP: name } });
    const env = { PYTHONPATH: at('backend') };
    await mustRun('run a fleet', python, ['-m', 'tests.keep_fleet', folder], { env });
  } catch (error) {
    rmSync(at(folder), { recursive: true, force: true });
    throw error;
  }
  return 0;
});
