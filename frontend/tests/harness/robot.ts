// The simulated robot of one test, on a serial port in the page, in the test's time. The same face as that of end-to-end tests.

import { heardIn } from '../../../e2e/fixtures/bus.ts';
import { install } from '../../../e2e/fixtures/portInPage.ts';
import type { BoardSettings } from '../../../e2e/fixtures/robot.ts';
import type { Page } from './page.ts';
import { advance, timeOriginMs, worldClock } from './time.ts';

const PORT = 'webSerial USB serial adapter (id 1234:5678)';

export function createRobot(page: Page, settings: BoardSettings) {
  install(settings, worldClock);
  const { portInPage } = window;
  const family = settings.board ?? 'doc';
  return {
    bus: () => Promise.resolve(heardIn({ startedAtEpochMs: timeOriginMs, entries: portInPage.entries })),
    /** Opens the dashboard where this robot was connected at the last visit; what board it has may be new to the page. */
    async open({ isKnown = true } = {}): Promise<void> {
      portInPage.allow();
      localStorage.setItem('servodeck.way', 'webSerial doc');
      if (isKnown)
        localStorage.setItem('servodeck.boards', JSON.stringify({ [PORT]: { family, nickname: '' } }));
      await page.goto('/');
    },
    async unplug() {
      portInPage.unplug();
      await advance(16);
    },
    async plugIn() {
      portInPage.plugIn();
      await advance(16);
    },
    turn: portInPage.turn,
  };
}

export type Robot = ReturnType<typeof createRobot>;
