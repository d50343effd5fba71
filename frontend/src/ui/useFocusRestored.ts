// Whoever works by keys sees where the focus is: when what had it is taken away or disabled, what was around it gets it. That does
// nothing when it is pressed, so that a hasty second Enter is nobody's wish. Dialogs and menus give the focus back by themselves.

import { useEffect, useRef } from 'react';
import { isTextField } from './pressOnce.ts';
import { useEachFrame } from './useEachFrame.ts';

// On Linux the middle button pastes into whatever has the focus. Where nobody writes it pans, and a hand that let go
// of it has asked for no keys.

const MIDDLE = 1;

export function useNoPasteByMouse(): void {
  useEffect(() => {
    const release = (event: MouseEvent): void => {
      if (event.button === MIDDLE && !isTextField(event.target)) event.preventDefault();
    };
    window.addEventListener('mouseup', release);
    return () => window.removeEventListener('mouseup', release);
  }, []);
}

export function useFocusRestored(): void {
  /** What had the focus last, then what is around it, from the inside out. */
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

/** Up to the page itself, which is no place. */
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
