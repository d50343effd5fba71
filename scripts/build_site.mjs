// `npm run build:site`: the built page as a static site that needs no gateway, for any web server and any path below it. It is the
// page of the wheel with a web app manifest and a service worker beside it.

import { cpSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { createHash } from 'node:crypto';
import { build } from 'vite';
import { LICENCES, licences } from './licences.mjs';
import { setUp } from './setup.mjs';
import { at, main, say } from './steps.mjs';

const page = at('backend/servodeck/static');
const site = at('build/site');
const extras = at('packaging/site');

/** A server that cannot set headers has the policy in the page. Web Serial and the like need no rule: they are the page's own. */
const CONTENT_POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data:; font-src 'self'; " +
  "connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'";

const HEAD = `
    <meta http-equiv="Content-Security-Policy" content="${CONTENT_POLICY}" />
    <meta name="servodeck-gateway" content="none" />
    <link rel="manifest" href="./manifest.webmanifest" />
    <link rel="apple-touch-icon" href="./icon-192.png" />`;

/** Compressed twins are for the gateway; hosts of sites compress by themselves. A fleet needs a gateway. */
const isOfSite = (/** @type {string} */ file) => !/[.](br|gz)$|[/\\]fleet[.]html$/.test(file);

function copyPage() {
  rmSync(site, { recursive: true, force: true });
  cpSync(page, site, { recursive: true, filter: isOfSite });
  cpSync(extras, site, { recursive: true });
  const index = path.join(site, 'index.html');
  writeFileSync(index, readFileSync(index, 'utf8').replace(/<meta charset="utf-8" \/>/, `$&${HEAD}`));
}

/** Names of hashed files change with their content; the others have a revision of their own. */
function filesToKeep() {
  return readdirSync(site, { recursive: true, withFileTypes: true })
    .filter((file) => file.isFile() && file.name !== '_headers')
    .map((file) => path.join(file.parentPath, file.name))
    .map((file) => {
      const url = path.relative(site, file).replaceAll(path.sep, '/');
      const revision = url.startsWith('assets/') ? null : hashOf(file);
      return { url, revision };
    })
    .sort((one, other) => one.url.localeCompare(other.url));
}

/** @param {string} file */
function hashOf(file) {
  return createHash('sha256').update(readFileSync(file)).digest('hex').slice(0, 16);
}

function buildServiceWorker() {
  return build({
    configFile: false,
    root: at(''),
    logLevel: 'warn',
    plugins: [licences(readFileSync(path.join(site, LICENCES), 'utf8'))],
    define: {
      'self.SITE_FILES': JSON.stringify(filesToKeep()),
      'process.env.NODE_ENV': '"production"',
    },
    build: {
      outDir: site,
      emptyOutDir: false,
      copyPublicDir: false,
      target: 'es2022',
      lib: { entry: 'frontend/src/app/serviceWorker.ts', formats: ['es'], fileName: () => 'sw.js' },
    },
  });
}

await main(async () => {
  await setUp();
  copyPage();
  await buildServiceWorker();
  say(
    `The site is in ${path.relative(at(''), site)}. Any web server can serve it; docs/static-site.md tells how.`,
  );
  return 0;
});
