// Decides which element's hint is shown: the one under a resting pointer or with the keyboard focus, until the next action. Touch screens
// have no hover and show none. Knows no tooltip.

import { shortcutsOf } from './action.ts';

export const HINT = 'data-hint';
const KEYS = 'data-hint-keys';
const WHY_NOT = 'data-hint-why-not';

export interface Hinted {
  /** What the name alone does not say. */
  readonly hint?: string | undefined;
  /** Keys that do the same; the first is shown. */
  readonly keys?: readonly string[] | undefined;
  /** Why it cannot be done now. */
  readonly whyNot?: string | undefined;
}

/** To be spread on what is explained. */
export function hinted({ hint, keys = [], whyNot }: Hinted) {
  const [shown] = keys;
  if (hint === undefined && shown === undefined && whyNot === undefined) return {};
  return {
    [HINT]: hint ?? '',
    ...(shown !== undefined && { [KEYS]: shown, 'aria-keyshortcuts': shortcutsOf(keys) }),
    ...(whyNot !== undefined && { [WHY_NOT]: whyNot }),
  };
}

export interface HintText {
  readonly text: string;
  readonly keys: string;
  readonly whyNot: string;
}

export function hintOf(element: Element): HintText {
  const said = (name: string): string => element.getAttribute(name) ?? '';
  return { text: said(HINT), keys: said(KEYS), whyNot: said(WHY_NOT) };
}

/** A pointer on its way to another element does not rest this long. */
const REST_MS = 500;
/** Within this time after a hint the next one shows at once. */
const AWAKE_MS = 300;

/** Calls `show` with the element whose hint is to be shown, null for none. */
export function attach(page: Document, show: (element: Element | null) => void) {
  let at: Element | null = null;
  let isShown = false;
  let shownUntilMs = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;

  function reveal(): void {
    isShown = true;
    show(at);
  }

  function hide(): void {
    clearTimeout(timer);
    if (!isShown) return;
    isShown = false;
    shownUntilMs = performance.now();
    show(null);
  }

  function come(element: Element | null, delayMs: number): void {
    if (element === at) return;
    const isAwake = isShown || performance.now() - shownUntilMs < AWAKE_MS;
    hide();
    at = element;
    if (element !== null) timer = setTimeout(reveal, isAwake ? 0 : delayMs);
  }

  const listening = new AbortController();
  const on = <Name extends keyof DocumentEventMap>(
    name: Name,
    hear: (event: DocumentEventMap[Name]) => void,
  ) => page.addEventListener(name, hear, { signal: listening.signal, capture: true, passive: true });
  on('pointerover', (event) => {
    if (event.pointerType !== 'touch') come(hintedAround(event.target), REST_MS);
  });
  on('pointerout', (event) => {
    if (event.relatedTarget === null) come(null, 0);
  });
  on('focusin', ({ target }) => {
    const element = hintedAround(target);
    if (element?.matches(':focus-visible') === true) come(element, 0);
  });
  on('focusout', () => come(null, 0));
  on('pointerdown', hide);
  on('keydown', hide);
  on('scroll', hide);

  return {
    hide,
    detach(): void {
      listening.abort();
      hide();
    },
  };
}

const hintedAround = (target: EventTarget | null): Element | null =>
  target instanceof Element ? target.closest(`[${HINT}]`) : null;
