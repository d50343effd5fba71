// What a page's main thread works, in time of its processor: who else works on the machine is not in it. Knows no page.

import type { Page } from '@playwright/test';

const MEASURES = { allMs: 'TaskDuration', scriptMs: 'ScriptDuration', layoutMs: 'LayoutDuration' } as const;

export type Work = Readonly<Record<keyof typeof MEASURES, number>>;

export interface MainThread {
  /** What it worked while `during` went on, and what came of that. */
  work<Result>(during: () => Promise<Result>): Promise<Work & { readonly result: Result }>;
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
    async slowDown(rate) {
      await tools.send('Emulation.setCPUThrottlingRate', { rate });
    },
  };
}
