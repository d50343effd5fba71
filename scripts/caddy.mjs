// The Caddy that the tests of HTTPS start (backend/tests/test_tls.py). Without one on PATH it is taken from the system's package,
// unpacked into build/ and not installed: an installed one would start itself as a service.

import { existsSync, mkdirSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { at, run, say } from './steps.mjs';

const folder = 'build/caddy';

/** Fetches it where that is possible; without it those tests are skipped. */
export async function caddyForTests() {
  const places = [...(process.env.PATH ?? '').split(path.delimiter), at(`${folder}/usr/bin`)];
  if (places.some((place) => existsSync(path.join(place, 'caddy')))) return;
  if (!existsSync('/usr/bin/apt-get')) return;
  say('Fetching Caddy for the tests of HTTPS …');
  mkdirSync(at(folder), { recursive: true });
  const download = () => run('/bin/sh', ['-c', `cd "${at(folder)}" && apt-get download caddy`]);
  if ((await download()).code !== 0 && process.getuid?.() === 0) {
    await run('apt-get', ['update']);
    await download();
  }
  const [found] = readdirSync(at(folder)).filter((file) => file.endsWith('.deb'));
  if (found !== undefined) await run('dpkg-deb', ['-x', at(`${folder}/${found}`), at(folder)]);
}
