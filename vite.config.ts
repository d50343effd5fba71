// How the page is built: into the Python package, so that one wheel serves it. Nothing inline and no data: addresses,
// because the gateway serves it under a strict Content-Security-Policy.

import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import react from '@vitejs/plugin-react';
import { minify } from 'terser';
import { defineConfig, type Plugin } from 'vite';
import { withoutSources } from './scripts/sources.mjs';
import { licences } from './scripts/licences.mjs';
import { words } from './scripts/words.mjs';

const gateway = 'http://127.0.0.1:8300';
// The gateway accepts its own Host and Origin only, so the development server speaks in its name.
const proxy = { target: gateway, changeOrigin: true, headers: { origin: gateway } };

/** Compressed files beside the plain ones, for the gateway: its loop, on which STOP waits, compresses nothing. */
function compressed(): Plugin {
  return {
    name: 'compressed',
    apply: 'build',
    writeBundle({ dir = '' }, bundle) {
      for (const name of Object.keys(bundle).filter((one) => /[.](js|css|html|svg|wasm)$/.test(one))) {
        const file = path.join(dir, name);
        const content = readFileSync(file);
        writeFileSync(`${file}.br`, brotliCompressSync(content));
        writeFileSync(`${file}.gz`, gzipSync(content, { level: 9 }));
      }
    },
  };
}

const page = path.resolve(import.meta.dirname, 'frontend/src');
const sheets = readdirSync(page, { recursive: true, encoding: 'utf8' }).filter(isSheet).sort();

function isSheet(file: string): boolean {
  return file.endsWith('.module.css');
}

const ENTRY = '/frontend/src/app/main.tsx';

/** What the dashboard's entry leads to without a dynamic import; parts that come later share much of it, and would cut it into dozens. */
const firstLoad = new Set<string>();

function readsFirstLoad(): Plugin {
  return {
    name: 'first-load',
    apply: 'build',
    buildEnd() {
      const walk = (id: string): void => {
        if (firstLoad.has(id)) return;
        firstLoad.add(id);
        this.getModuleInfo(id)?.importedIds.forEach(walk);
      };
      firstLoad.clear();
      for (const id of this.getModuleIds()) if (id.endsWith(ENTRY)) walk(id);
    },
  };
}

/**
 * Node knows no other import of JSON than that of the whole; of a namespace the bundler sees which sections are used, and puts their numbers
 * where they are. 0.7 KiB of the first load.
 */
function numbersInPlace(): Plugin {
  return {
    name: 'numbers-in-place',
    enforce: 'pre',
    apply: 'build',
    transform: {
      filter: { code: /[/]protocol[/](?:timings|robots)[.]json/ },
      handler: (text) => ({
        code: text.replace(
          /import (\w+) from ('[^']+[/](?:timings|robots)[.]json') with [^;]+/,
          'import * as $1 from $2',
        ),
        map: null,
      }),
    },
  };
}

/** The bundler minifies all; what terser has been over before is 2 KiB smaller. */
function squeezed(): Plugin {
  return {
    name: 'squeezed',
    apply: 'build',
    async renderChunk(text, { name }) {
      if (name !== 'page') return null;
      const { code = text } = await minify(text, { module: true, ecma: 2020, compress: { passes: 2 } });
      return { code, map: null };
    },
  };
}

export default defineConfig({
  root: 'frontend',
  base: './',
  plugins: [
    react(),
    words(),
    withoutSources(),
    numbersInPlace(),
    readsFirstLoad(),
    squeezed(),
    licences(),
    compressed(),
  ],
  css: {
    modules: {
      // By the sheet's number, which compresses well.
      generateScopedName: (name, file) =>
        `${name}_${sheets.indexOf(path.relative(page, file.replace(/[?].*/, '')))}`,
    },
  },
  server: {
    host: '127.0.0.1',
    proxy: { '/api': proxy, '/ws': { ...proxy, ws: true } },
  },
  build: {
    outDir: '../backend/servodeck/static',
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    // One style sheet from the start: parts that come later change the look of nothing that is there.
    cssCodeSplit: false,
    reportCompressedSize: false,
    rolldownOptions: {
      input: ['index.html', 'fleet.html'].map((name) => path.resolve(import.meta.dirname, 'frontend', name)),
      output: {
        // A character less in each of the many names that the first load knows.
        chunkFileNames: 'assets/[name]-[hash:7].js',
        codeSplitting: {
          groups: [
            // Changes less often than the page: a browser keeps it.
            { name: 'react', test: /node_modules.(react|react-dom|scheduler)[/\\]/, priority: 2 },
            // Without the entry, which would start the dashboard in the fleet's page, too.
            { name: 'page', test: (id) => firstLoad.has(id) && !id.endsWith(ENTRY), priority: 1 },
          ],
        },
      },
    },
  },
});
