// `npm run build:docs`: the documentation as a site of its own, in English and Chinese, for any web server and any path below it.

import { buildDocs, site } from './docs_site.mjs';
import { setUpPackages } from './setup.mjs';
import { main, say } from './steps.mjs';

await main(async () => {
  await setUpPackages();
  await buildDocs();
  say(`The documentation is in ${site}. Any web server can serve it.`);
  return 0;
});
