// The documentation site builds, asks no other host for anything, and its search finds words of both languages. Every page is read as
// text; some are opened in a Chromium, which sees what scripts ask for.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { chromium } from '@playwright/test';
import { preview } from 'vite';
import { browserArgs, findBrowser } from './browser.mjs';
import { buildDocs, site } from './docs_site.mjs';
import { SetupProblem, at, main } from './steps.mjs';

/** What a browser loads by itself: a source, a style, a preloaded file, an address in a style. Links are no such thing. */
const LOADED = [
  /\s(?:src|srcset|poster|data)\s*=\s*["']?\s*(?:https?:)?\/\/[^\s"'>]+/gi,
  /<link\b(?=[^>]*\brel=["']?(?:stylesheet|preload|modulepreload|prefetch|preconnect|icon|manifest))[^>]*\bhref=["']?(?:https?:)?\/\/[^>]*>/gi,
  /url\(\s*["']?(?:https?:)?\/\/[^)]*\)/gi,
  /@import\s+["'](?:https?:)?\/\/[^"']*/gi,
];
const OPENED = ['', 'connect/', 'animate/', 'protocol/boards/', 'adr/', 'zh/', 'zh/connect/', 'zh/scripts/'];
const SEARCHES = [
  { page: '', words: 'gripper' },
  { page: 'zh/', words: '槽位' },
];

function foreignAddresses() {
  return readdirSync(at(site), { recursive: true, encoding: 'utf8' })
    .filter((file) => /[.](html|css)$/.test(file))
    .flatMap((file) => {
      const text = readFileSync(path.join(at(site), file), 'utf8');
      return LOADED.flatMap((pattern) => text.match(pattern) ?? []).map((found) => `${file}: ${found}`);
    });
}

/** @param {import('@playwright/test').Browser} browser @param {string} url */
async function problemsInBrowser(browser, url) {
  const page = await browser.newPage();
  /** @type {string[]} */
  const problems = [];
  await page.route('**/*', (route) => {
    if (route.request().url().startsWith(url)) return route.continue();
    problems.push(`${page.url()} asks ${route.request().url()}`);
    return route.abort();
  });
  page.on('response', (response) => {
    if (response.status() >= 400) problems.push(`${response.url()} is not there`);
  });
  page.on('pageerror', (error) => problems.push(`${page.url()}: ${error.message}`));
  for (const place of OPENED) await page.goto(url + place);
  for (const { page: place, words } of SEARCHES) {
    // Types the words itself, once its index is there.
    await page.goto(`${url}${place}?q=${encodeURIComponent(words)}`);
    await page.locator('.md-search-result__item').filter({ hasText: words }).first().waitFor();
  }
  return problems;
}

await main(async () => {
  const executablePath = findBrowser();
  if (executablePath === null) throw new SetupProblem('The site is opened in a Chromium, and there is none.');
  await buildDocs();
  assert.deepEqual(foreignAddresses(), []);
  const server = await preview({
    configFile: false,
    root: at(''),
    logLevel: 'warn',
    appType: 'mpa',
    build: { outDir: site },
    preview: { port: 0 },
  });
  const browser = await chromium.launch({
    executablePath,
    args: [...browserArgs, ...(process.getuid?.() === 0 ? ['--no-sandbox'] : [])],
  });
  try {
    assert.deepEqual(await problemsInBrowser(browser, server.resolvedUrls?.local[0] ?? ''), []);
  } finally {
    await browser.close();
    await server.close();
  }
  return 0;
});
