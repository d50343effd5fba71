// Finds what a person finds, by role and name, and acts on it: as much of Playwright's Locator as component tests use, so that
// a test reads the same here and end to end. Each act waits, in the page's time, until its target is there and can be met.

import {
  getByLabelSelector,
  getByRoleSelector,
  getByTextSelector,
  selectorEngine,
} from '@vitest/browser/locators';
import { commands } from 'vitest/browser';
import type { MouseButton } from './commands.ts';
import { act, clickAt, touchscreen, type Point } from './input.ts';
import { during, eventually, realFrame } from './time.ts';

type Modifier = 'Control' | 'Shift' | 'Alt' | 'Meta' | 'ControlOrMeta';
interface TextOptions {
  readonly exact?: boolean;
}
type RoleOptions = Parameters<typeof getByRoleSelector>[1];
interface Filter {
  readonly has?: Locator;
  readonly hasNot?: Locator;
  readonly hasText?: string | RegExp;
  readonly visible?: boolean;
}
interface ClickOptions {
  readonly modifiers?: readonly Modifier[];
  readonly position?: Point;
  readonly button?: MouseButton;
  readonly timeout?: number;
}

const styleOf = window.getComputedStyle.bind(window);
/** Vitest reads content before or after an element into its name also where CSS hides it; a browser does not. */
window.getComputedStyle = (element, pseudo) => {
  const style = styleOf(element, pseudo);
  return Boolean(pseudo) && style.visibility === 'hidden' ? styleOf(element) : style;
};

export class Locator {
  readonly selector: string;

  constructor(selector: string) {
    this.selector = selector;
  }

  // Looking.

  elements(): HTMLElement[] {
    return this.selector === ''
      ? [document.documentElement]
      : (selectorEngine.querySelectorAll(
          selectorEngine.parseSelector(this.selector),
          document,
        ) as HTMLElement[]);
  }

  /** The only one. Throws where there is none, or several. */
  element(): HTMLElement {
    const [found, ...others] = this.elements();
    if (found === undefined) throw new Error(`nothing is there: ${this.selector}`);
    if (others.length > 0) {
      const seen = [found, ...others].map((one) => one.outerHTML.slice(0, 120));
      throw new Error(`several are there: ${this.selector}\n${seen.join('\n')}`);
    }
    return found;
  }

  #within(selector: string): Locator {
    return new Locator(this.selector === '' ? selector : `${this.selector} >> ${selector}`);
  }

  getByRole = (role: string, options?: RoleOptions) => this.#within(getByRoleSelector(role, options ?? {}));
  getByText = (text: string | RegExp, options?: TextOptions) =>
    this.#within(getByTextSelector(text, options));
  getByLabel = (text: string | RegExp, options?: TextOptions) =>
    this.#within(getByLabelSelector(text, options));
  locator = (css: string) => this.#within(css);
  nth = (index: number) => this.#within(`nth=${index}`);
  first = () => this.nth(0);
  last = () => this.nth(-1);
  and = (other: Locator) => this.#within(`internal:and=${JSON.stringify(other.selector)}`);
  or = (other: Locator) => this.#within(`internal:or=${JSON.stringify(other.selector)}`);

  filter({ has, hasNot, hasText, visible }: Filter): Locator {
    const conditions = [
      ...(has ? [`internal:has=${JSON.stringify(has.selector)}`] : []),
      ...(hasNot ? [`internal:has-not=${JSON.stringify(hasNot.selector)}`] : []),
      ...(hasText === undefined ? [] : [getByTextSelector(hasText).replace(':text=', ':has-text=')]),
      ...(visible === undefined ? [] : [`visible=${visible}`]),
    ];
    return this.#within(conditions.join(' >> '));
  }

  count = () => Promise.resolve(this.elements().length);
  all = () => Promise.resolve(this.elements().map((_, index) => this.nth(index)));
  isVisible = () => Promise.resolve(this.elements().some(isVisible));
  allTextContents = () => Promise.resolve(this.elements().map(({ textContent }) => textContent));

  #read<T>(read: (element: HTMLElement) => T | Promise<T>): Promise<T> {
    return eventually(() => this.element()).then(read);
  }

  textContent = () => this.#read((element) => element.textContent);
  innerText = () => this.#read((element) => element.innerText);
  inputValue = () => this.#read((element) => (element as HTMLInputElement).value);
  getAttribute = (name: string) => this.#read((element) => element.getAttribute(name));
  isChecked = () => this.#read(isChecked);
  isEnabled = () => this.#read((element) => !isDisabled(element));

  boundingBox = () =>
    this.#read((element) => {
      const { x, y, width, height } = element.getBoundingClientRect();
      return { x, y, width, height };
    });

  evaluate = <T, A>(read: (element: HTMLInputElement, argument: A) => T, argument?: A): Promise<Awaited<T>> =>
    this.#read((element) => during(Promise.resolve(read(element as HTMLInputElement, argument as A))));

  evaluateAll = <T>(read: (elements: HTMLElement[]) => T) => Promise.resolve(read(this.elements()));

  evaluateHandle = async <T, A>(read: (element: HTMLInputElement, argument: A) => T, argument?: A) =>
    handleOf(await this.evaluate(read, argument));

  screenshot = () =>
    this.#read(async (element) => {
      element.scrollIntoView({ block: 'nearest', inline: 'nearest' });
      await realFrame();
      const { x, y, width, height } = element.getBoundingClientRect();
      const frame = window.frameElement?.getBoundingClientRect() ?? { x: 0, y: 0 };
      const base64 = await commands.picture({ x: x + frame.x, y: y + frame.y, width, height });
      return { equals: (other: { readonly base64: string }) => other.base64 === base64, base64 };
    });

  // Acting.

  /** Where a press meets it: scrolled into sight, at rest for a frame, with nothing before it. */
  #place(
    { position, timeout }: Pick<ClickOptions, 'position' | 'timeout'> = {},
    isRefused: (element: Element) => boolean = isDisabled,
  ): Promise<Point> {
    return eventually(async () => {
      const element = this.element();
      if (!isVisible(element)) throw new Error(`not to be seen: ${this.selector}`);
      if (isRefused(element)) throw new Error(`disabled: ${this.selector}`);
      if (!isMetAt(element, metAt(pointOf(element, position))))
        element.scrollIntoView({ block: 'center', inline: 'center', behavior: 'instant' });
      const scrolled = pointOf(element, position);
      await realFrame();
      const at = pointOf(element, position);
      if (at?.x !== scrolled?.x || at?.y !== scrolled?.y) throw new Error(`it moves: ${this.selector}`);
      const met = metAt(at);
      if (at !== null && isMetAt(element, met)) return at;
      throw new Error(
        `${met === null ? 'nothing of the page' : shortly(met)} is before it: ${this.selector}`,
      );
    }, timeout);
  }

  #press(times: number, options: ClickOptions = {}): Promise<void> {
    return eventually(async () => {
      const at = await this.#place(options);
      const other = await otherMet(this.element(), () => clickAt(at, times, options));
      if (other !== null) throw new Error(`${other} came before it: ${this.selector}`);
    }, options.timeout);
  }

  async click(options: ClickOptions = {}): Promise<void> {
    const held = (options.modifiers ?? []).map((key) => (key === 'ControlOrMeta' ? 'Control' : key));
    if (held.length > 0) await act(...held.map((key) => ['keyDown', key] as const));
    await this.#press(1, options);
    if (held.length > 0) await act(...held.map((key) => ['keyUp', key] as const));
  }

  dblclick = (options?: ClickOptions) => this.#press(2, options);
  async tap(): Promise<void> {
    const { x, y } = await this.#place();
    await touchscreen.tap(x, y);
  }

  async hover(options?: ClickOptions): Promise<void> {
    const { x, y } = await this.#place(options, () => false);
    await act(['move', x, y]);
  }

  async #setChecked(wanted: boolean): Promise<void> {
    if ((await this.isChecked()) === wanted) return;
    await this.click();
    await eventually(() => {
      // It may be gone with that.
      if (this.elements().some((element) => isChecked(element) !== wanted))
        throw new Error(`a click did not change it: ${this.selector}`);
    });
  }

  check = () => this.#setChecked(true);
  uncheck = () => this.#setChecked(false);

  focus = () =>
    this.#read(async (element) => {
      element.focus();
      await act();
    });
  blur = () =>
    this.#read(async (element) => {
      element.blur();
      await act();
    });

  async press(key: string): Promise<void> {
    await this.#read((element) => element.focus());
    await act(['press', key]);
  }

  async fill(text: string): Promise<void> {
    await eventually(() => {
      const field = this.element() as HTMLInputElement;
      if (!isVisible(field) || isInactive(field) || field.readOnly)
        throw new Error(`nothing can be written here: ${this.selector}`);
      field.focus();
      if (field.type === 'range') return slide(field, text);
      field.select();
      // At once, before anything else takes the focus.
      // oxlint-disable-next-line typescript/no-deprecated
      document.execCommand(text === '' ? 'delete' : 'insertText', false, text);
    });
    await act();
  }

  clear = () => this.fill('');

  async pressSequentially(text: string): Promise<void> {
    await this.focus();
    await act(['type', text]);
  }

  async selectOption(label: string): Promise<void> {
    const option = await eventually(() => {
      const { options } = this.element() as HTMLSelectElement;
      const found = [...options].find((one) => one.value === label || one.label === label);
      if (found === undefined) throw new Error(`no option ${label}: ${this.selector}`);
      return found;
    });
    const select = this.element() as HTMLSelectElement;
    select.focus();
    option.selected = true;
    select.dispatchEvent(new Event('input', { bubbles: true, composed: true }));
    select.dispatchEvent(new Event('change', { bubbles: true }));
    await act();
  }

  /** As the browser's driver does it, by a way of Chromium's own. */
  scrollIntoViewIfNeeded = () =>
    this.#read(async (element) => {
      (element as HTMLElement & { scrollIntoViewIfNeeded(): void }).scrollIntoViewIfNeeded();
      await realFrame();
    });

  dispatchEvent = (type: string, { dataTransfer }: { readonly dataTransfer?: DataTransfer } = {}) =>
    this.#read(async (element) => {
      const usual = { bubbles: true, cancelable: true, composed: true };
      if (dataTransfer) element.dispatchEvent(new DragEvent(type, { ...usual, dataTransfer }));
      else element.dispatchEvent(new (type === 'click' ? MouseEvent : Event)(type, usual));
      await act();
    });

  waitFor = ({ state = 'visible' }: { state?: 'visible' | 'hidden' } = {}) =>
    eventually(() => {
      if (this.elements().some(isVisible) !== (state === 'visible'))
        throw new Error(`not ${state}: ${this.selector}`);
    });
}

export function handleOf<T>(value: T) {
  return {
    evaluate: <R, A>(read: (value: T, argument: A) => R, argument?: A) =>
      Promise.resolve(read(value, argument as A)),
    jsonValue: () => Promise.resolve(structuredClone(value)),
  };
}

export function isVisible(element: Element): boolean {
  const { width, height } = element.getBoundingClientRect();
  return element.checkVisibility({ visibilityProperty: true }) && width > 0 && height > 0;
}

export function isChecked(element: Element): boolean {
  return element instanceof HTMLInputElement ? element.checked : element.ariaChecked === 'true';
}

/** Said to be so, though it may still be met. */
export function isDisabled(element: Element): boolean {
  return isInactive(element) || element.closest('[aria-disabled="true"]') !== null;
}

const isInactive = (element: Element): boolean => element.matches(':disabled');

/** At once, as by a hand that lets go there. React listens to the element's own setter. */
function slide(field: HTMLInputElement, value: string): void {
  Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value')?.set?.call(field, value);
  for (const event of ['input', 'change']) field.dispatchEvent(new Event(event, { bubbles: true }));
}

/** null where something else would be met there. */
function pointOf(element: HTMLElement, position?: Point): Point | null {
  const [box] = [...element.getClientRects()].filter(({ width, height }) => width > 0 && height > 0);
  if (box === undefined) return null;
  const x = position === undefined ? box.x + box.width / 2 : box.x + position.x;
  const y = position === undefined ? box.y + box.height / 2 : box.y + position.y;
  return { x, y };
}

const metAt = (at: Point | null): Element | null => at && document.elementFromPoint(at.x, at.y);

function isMetAt(element: HTMLElement, met: EventTarget | null): boolean {
  const label =
    element.closest('label') ?? ('labels' in element ? (element as HTMLInputElement).labels?.[0] : null);
  return met instanceof Node && (element.contains(met) || (label?.contains(met) ?? false));
}

const PRESSING = ['pointerdown', 'mousedown', 'pointerup', 'mouseup', 'click', 'dblclick'];

/** What a press meets instead of it, null for nothing. Then nothing of the page hears of the press. */
async function otherMet(element: HTMLElement, press: () => Promise<void>): Promise<string | null> {
  const listening = new AbortController();
  let other: string | null = 'no event';
  const judge = (event: Event): void => {
    if (other === 'no event') other = isMetAt(element, event.target) ? null : described(event);
    if (other === null) return;
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  for (const type of PRESSING)
    window.addEventListener(type, judge, { capture: true, signal: listening.signal });
  await press().finally(() => listening.abort());
  return other;
}

function described({ type, target }: Event): string {
  return `${type} on ${target instanceof Element ? shortly(target) : 'the page'}`;
}

const shortly = (element: Element): string => element.outerHTML.slice(0, 200);
