// Passes key events to the pad before any panel gets them, except in text fields, and reports when the page is hidden or loses the
// focus. Knows the browser's events and no robot.

import type { Pad } from './pad.ts';
import { isTextField } from '../../ui/inputEvents.ts';

type Listener = Pick<Pad, 'keyDown' | 'keyUp' | 'leave' | 'comeBack'>;

export function watchInputs(page: Pick<Window, 'addEventListener' | 'document'>, pad: Listener): void {
  const { document } = page;
  page.addEventListener(
    'keydown',
    (event) => {
      const isForOthers = event.ctrlKey || event.metaKey || event.altKey || isTextField(event.target);
      if (isForOthers || !pad.keyDown(event.code, event.repeat)) return;
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );
  page.addEventListener('keyup', () => pad.keyUp(), { capture: true });
  page.addEventListener('blur', () => pad.leave());
  page.addEventListener('focus', () => pad.comeBack());
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') pad.leave();
    else if (document.hasFocus()) pad.comeBack();
  });
}
