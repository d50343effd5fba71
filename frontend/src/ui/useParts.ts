// F6 goes from one part of the page to the next and Shift+F6 back, to where the keys were in it last: from the sliders to the
// frames with one press, not with forty. A dialog is alone on the page while it is open.

import { useEffect } from 'react';

/** What a part of the page bears. */
export const PART = { 'data-part': '' } as const;

const PARTS = '[data-part]';
const STOPS = 'a[href], button, input, select, textarea, [tabindex]';

export function useParts(): void {
  useEffect(() => {
    const lastIn = new WeakMap<Element, HTMLElement>();

    function note({ target }: FocusEvent): void {
      const part = partOf(target);
      if (part !== null && target instanceof HTMLElement) lastIn.set(part, target);
    }

    function go(event: KeyboardEvent): void {
      if (event.key !== 'F6' || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      const stops = [...document.querySelectorAll(PARTS)]
        .flatMap((part) => {
          const [first, last] = [firstStop(part), lastIn.get(part)];
          const isLastThere = last !== undefined && part.contains(last) && isStop(last);
          return first === undefined ? [] : [{ part, first, stop: isLastThere ? last : first }];
        })
        .toSorted((one, other) => (isBefore(one.first, other.first) ? -1 : 1));
      const here = stops.findIndex(({ part }) => part === partOf(document.activeElement));
      const next = event.shiftKey ? (here < 0 ? -1 : here - 1) : here + 1;
      stops.at(next % Math.max(1, stops.length))?.stop.focus();
    }

    document.addEventListener('focusin', note);
    window.addEventListener('keydown', go);
    return () => {
      document.removeEventListener('focusin', note);
      window.removeEventListener('keydown', go);
    };
  }, []);
}

const partOf = (target: EventTarget | null): Element | null =>
  target instanceof Element ? target.closest(PARTS) : null;

/** Of its own: a part may have others within it. */
const firstStop = (part: Element): HTMLElement | undefined =>
  [...part.querySelectorAll<HTMLElement>(STOPS)].find((stop) => partOf(stop) === part && isStop(stop));

const isBefore = (one: Element, other: Element): boolean =>
  (one.compareDocumentPosition(other) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;

/** Of a group of radio buttons Tab finds the chosen one. */
function isStop(element: HTMLElement): boolean {
  const isOther = element instanceof HTMLInputElement && element.type === 'radio' && !element.checked;
  const isThere = element.checkVisibility() && element.closest('[inert], [aria-hidden="true"]') === null;
  return isThere && !isOther && element.tabIndex >= 0 && !element.matches(':disabled');
}
