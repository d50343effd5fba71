// 103 files of action groups in every format: how long they take to be opened in the dialog and to be taken into the library
// with Open all, and the longest task of the page's main thread meanwhile: nothing moves on the page while it lasts.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from '@playwright/test';
import startSqlite from 'sql.js';
import { mixedFiles } from '#shared/testing/groups.ts';
import { fileMeans } from '../frontend/src/features/library/files/means.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { mainThreadOf } from './mainThread.ts';
import { openDashboard, temporaryFolder, withBoard, withPage } from './station.ts';

const FILES = amount(103, 15);
const TASK_LIMIT_MS = 50;
const WAIT_MS = 60_000;
const POLL_MS = 50;

export async function measureFiles(): Promise<Figure[]> {
  const sqlite = await startSqlite();
  const files = await mixedFiles(FILES, fileMeans(() => Promise.resolve(sqlite)).makeDatabase);
  const folder = temporaryFolder();
  const paths = files.map(({ name, content }) => {
    const path = join(folder, name);
    writeFileSync(path, content);
    return path;
  });
  return withBoard([], (board) =>
    withPage(board.device, async (page, url) => {
      const thread = await mainThreadOf(page);
      await openDashboard(page, url);
      await page.getByRole('button', { name: 'Files' }).click();
      const reading = await thread.longestTask(() => timeOf(() => choose(page, paths)));
      const all = await page.getByRole('button', { name: `Open all ${FILES}` }).elementHandle();
      const taking = await thread.longestTask(() =>
        timeOf(async () => {
          await all.evaluate((button) => (button as HTMLElement).click());
          while ((await documentsAt(url)) < FILES) await page.waitForTimeout(POLL_MS);
        }),
      );
      return [
        ...figuresOf('read', 'opened in the dialog', reading),
        ...figuresOf('take', 'taken into the library', taking),
      ];
    }),
  );
}

function figuresOf(
  name: string,
  what: string,
  { ms, result }: { readonly ms: number; readonly result: number },
): Figure[] {
  const limit = { atMost: TASK_LIMIT_MS };
  return [
    { key: `files.${name}Ms`, value: result, unit: 'ms', note: `${FILES} files of all formats, ${what}` },
    {
      key: `files.${name}LongestTaskMs`,
      value: ms,
      unit: 'ms',
      limit,
      note: 'the longest task of the main thread for it, in time of the processor',
    },
  ];
}

async function timeOf(work: () => Promise<void>): Promise<number> {
  const startMs = performance.now();
  await work();
  return performance.now() - startMs;
}

async function choose(page: Page, paths: readonly string[]): Promise<void> {
  const choosing = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Choose files' }).click();
  await (await choosing).setFiles([...paths]);
  // To look for it by its role would cost the page more than what is measured.
  await page.waitForFunction(
    (count) => document.querySelectorAll('[role=dialog] li').length >= count,
    FILES,
    {
      polling: POLL_MS,
      timeout: WAIT_MS,
    },
  );
}

/** Groups of the gateway's library. */
async function documentsAt(url: string): Promise<number> {
  const response = await fetch(`${url}/api/library`);
  const { documents } = (await response.json()) as { documents: readonly { facts: { kind: string } }[] };
  return documents.filter(({ facts }) => facts.kind === 'group').length;
}
