// Each way in which a page goes, as the browser tells it.

import { expect, test } from 'vitest';
import { watchLeaving } from './arrival.ts';

function openPage(): { page: Window; events: string[]; show(state: DocumentVisibilityState): void } {
  const document = Object.assign(new EventTarget(), {
    visibilityState: 'visible',
  });
  const page = Object.assign(new EventTarget(), { document }) as unknown as Window;
  const events: string[] = [];
  watchLeaving(page, { hidden: () => events.push('hidden'), left: () => events.push('left') });
  return {
    ...{ page, events },
    show(state) {
      document.visibilityState = state;
      document.dispatchEvent(new Event('visibilitychange'));
    },
  };
}

test('a page that is hidden gets a call, one that is shown again is not', () => {
  const { events, show } = openPage();
  show('hidden');
  show('visible');
  expect(events).toEqual(['hidden']);
});

test('a page that is closed or frozen has been left', () => {
  const { page, events } = openPage();
  page.dispatchEvent(new Event('pagehide'));
  page.document.dispatchEvent(new Event('freeze'));
  expect(events).toEqual(['left', 'left']);
});
