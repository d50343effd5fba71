// Keyboard focus on the whole page: going from part to part, and restoring a focus that would get lost.

import { useEffect, useRef } from 'react';
import { isTextField } from './inputEvents.ts';
import { useEachFrame } from './useEachFrame.ts';

/** Attributes of a part of the page. */
export const PART = { 'data-part': '' } as const;

const PARTS = '[data-part]';
const STOPS = 'a[href], button, input, select, textarea, [tabindex]';

/** The element of each part that had the focus last. */
const lastIn = new WeakMap<Element, HTMLElement>();

/** Tracks the focus within each part, for `goToPart`. */
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

/** Focuses the next or previous part, at the element that had the focus last. An open dialog is the only part. */
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

/** Without those of parts within this one. */
const firstStop = (part: Element): HTMLElement | undefined =>
  [...part.querySelectorAll<HTMLElement>(STOPS)].find((stop) => partOf(stop) === part && isStop(stop));

const isBefore = (one: Element, other: Element): boolean =>
  (one.compareDocumentPosition(other) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0;

/** Tab reaches only the checked button of a radio group. */
function isStop(element: HTMLElement): boolean {
  const isOther = element instanceof HTMLInputElement && element.type === 'radio' && !element.checked;
  const isThere = element.checkVisibility() && element.closest('[inert], [aria-hidden="true"]') === null;
  return isThere && !isOther && element.tabIndex >= 0 && !element.matches(':disabled');
}

const MIDDLE = 1;

/** On Linux the middle button pastes into the focused element. Outside text fields it pans, so the paste is suppressed. */
export function useNoPasteByMouse(): void {
  useEffect(() => {
    const release = (event: MouseEvent): void => {
      if (event.button === MIDDLE && !isTextField(event.target)) event.preventDefault();
    };
    window.addEventListener('mouseup', release);
    return () => window.removeEventListener('mouseup', release);
  }, []);
}

/**
 * When the focused element is removed or disabled, the nearest element around it gets the focus. That one ignores Enter, so a second
 * press does nothing. Dialogs and menus restore the focus themselves.
 */
export function useFocusRestored(): void {
  /** The element that had the focus last, then its ancestors from the inside out. */
  const path = useRef<readonly HTMLElement[]>([]);

  useEffect(() => {
    const note = ({ target }: FocusEvent): void => void (path.current = pathOf(target));
    document.addEventListener('focusin', note);
    return () => document.removeEventListener('focusin', note);
  }, []);

  useEachFrame(() => {
    if (path.current.length === 0 || document.activeElement !== document.body) return;
    const [held, ...around] = path.current;
    path.current = [];
    if (held === undefined || (held.isConnected && !held.matches(':disabled'))) return;
    const next = around.find((element) => element.isConnected);
    if (next !== undefined) focusOnce(next);
  });
}

/** Without `body` and the root element of the page. */
function pathOf(target: EventTarget | null): readonly HTMLElement[] {
  const path: HTMLElement[] = [];
  for (let element = target; element instanceof HTMLElement && element !== document.body;) {
    path.push(element);
    element = element.parentElement;
  }
  return path.slice(0, -1);
}

function focusOnce(element: HTMLElement): void {
  if (element.tabIndex < 0 && !element.hasAttribute('tabindex')) {
    element.setAttribute('tabindex', '-1');
    element.addEventListener('blur', () => element.removeAttribute('tabindex'), { once: true });
  }
  element.focus({ preventScroll: true });
}
