// The way from one part of the page to the next and back, to where the focus was in it last: from the sliders to the
// frames with one press, not with forty. A dialog is alone on the page while it is open.

import { useEffect } from 'react';

/** What a part of the page bears. */
export const PART = { 'data-part': '' } as const;

const PARTS = '[data-part]';
const STOPS = 'a[href], button, input, select, textarea, [tabindex]';

/** Where the focus was last in each part. */
const lastIn = new WeakMap<Element, HTMLElement>();

export function useParts(): void {
  useEffect(() => {
    const note = ({ target }: FocusEvent): void => {
      const part = partOf(target);
      if (part !== null && target instanceof HTMLElement) lastIn.set(part, target);
    };
    document.addEventListener('focusin', note);
    return () => document.removeEventListener('focusin', note);
  }, []);
}

export function goToPart(direction: 1 | -1): void {
  const stops = [...document.querySelectorAll(PARTS)]
    .flatMap((part) => {
      const [first, last] = [firstStop(part), lastIn.get(part)];
      const isLastThere = last !== undefined && part.contains(last) && isStop(last);
      return first === undefined ? [] : [{ part, first, stop: isLastThere ? last : first }];
    })
    .toSorted((one, other) => (isBefore(one.first, other.first) ? -1 : 1));
  const here = stops.findIndex(({ part }) => part === partOf(document.activeElement));
  const next = direction === -1 ? (here < 0 ? -1 : here - 1) : here + 1;
  stops.at(next % Math.max(1, stops.length))?.stop.focus();
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
