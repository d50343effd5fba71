// What a page's main thread works, in time of its processor: who else works on the machine is not in it. Knows no page.

import type { Page } from '@playwright/test';

const MEASURES = { allMs: 'TaskDuration', scriptMs: 'ScriptDuration', layoutMs: 'LayoutDuration' } as const;

export type Work = Readonly<Record<keyof typeof MEASURES, number>>;

export interface MainThread {
  /** What it worked while `during` went on, and what came of that. */
  work<Result>(during: () => Promise<Result>): Promise<Work & { readonly result: Result }>;
  /** The longest task of the page while `during` went on, in time of its processor; what came of that. */
  longestTask<Result>(
    during: () => Promise<Result>,
  ): Promise<{ readonly ms: number; readonly result: Result }>;
  /** 1: as fast as it is. */
  slowDown(rate: number): Promise<void>;
}

export async function mainThreadOf(page: Page): Promise<MainThread> {
  const tools = await page.context().newCDPSession(page);
  await tools.send('Performance.enable', { timeDomain: 'threadTicks' });

  async function total(): Promise<Work> {
    const { metrics } = await tools.send('Performance.getMetrics');
    const seconds = (name: string): number => metrics.find((metric) => metric.name === name)?.value ?? NaN;
    const times = Object.entries(MEASURES).map(([key, name]) => [key, 1_000 * seconds(name)]);
    return Object.fromEntries(times) as Work;
  }

  return {
    async work(during) {
      const before = await total();
      const result = await during();
      const after = await total();
      return {
        ...{ allMs: after.allMs - before.allMs, scriptMs: after.scriptMs - before.scriptMs },
        ...{ layoutMs: after.layoutMs - before.layoutMs, result },
      };
    },
    async longestTask(during) {
      const browser = page.context().browser();
      if (browser === null) throw new TypeError('a page without a browser cannot be traced');
      await browser.startTracing(page, { categories: ['toplevel', '__metadata'] });
      const result = await during();
      return { ms: longestIn((await browser.stopTracing()).toString()), result };
    },
    async slowDown(rate) {
      await tools.send('Emulation.setCPUThrottlingRate', { rate });
    },
  };
}

interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  /** In µs of the thread's processor time. */
  readonly tdur?: number;
  readonly args?: { readonly name?: string };
}

/** Of the main threads of all renderers: a browser under measurement shows one page. */
function longestIn(trace: string): number {
  const { traceEvents } = JSON.parse(trace) as { traceEvents: readonly TraceEvent[] };
  const threadOf = ({ pid, tid }: TraceEvent): string => `${pid} ${tid}`;
  const isName = (event: TraceEvent): boolean =>
    event.name === 'thread_name' && event.args?.name === 'CrRendererMain';
  const mainThreads = new Set(traceEvents.filter(isName).map(threadOf));
  const tasks = traceEvents.filter(
    (event) => event.name.endsWith('RunTask') && mainThreads.has(threadOf(event)),
  );
  return tasks.reduce((most, { tdur = 0 }) => Math.max(most, tdur / 1_000), 0);
}
