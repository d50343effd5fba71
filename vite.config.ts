// How the page is built: into the Python package, so that one wheel serves it. Nothing inline and no data: addresses,
// because the gateway serves it under a strict Content-Security-Policy.

import { resolve } from 'node:path';
import react from '@vitejs/plugin-react';
import { defineConfig } from 'vite';

const gateway = 'http://127.0.0.1:8300';
// The gateway accepts its own Host and Origin only, so the development server speaks in its name.
const proxy = { target: gateway, changeOrigin: true, headers: { origin: gateway } };

export default defineConfig({
  root: 'frontend',
  base: './',
  plugins: [react()],
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
    reportCompressedSize: false,
    rolldownOptions: {
      // In full: the build and the development server begin at different folders.
      input: ['index.html', 'gallery.html'].map((page) => resolve(import.meta.dirname, 'frontend', page)),
      // The packages change less often than the page: a browser keeps them. SQLite is fetched only when it is wanted.
      output: { codeSplitting: { groups: [{ name: 'packages', test: /node_modules(?!.*sql[.]js)/ }] } },
    },
  },
});
