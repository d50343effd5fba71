// `expect` as Playwright's: what is expected of a place in the page, or polled, is waited for in the page's time. The comparing
// is Vitest's.

import { expect as compare } from 'vitest';
import { isChecked, isDisabled, isVisible, Locator } from './locator.ts';
import { eventually, realFrame } from './time.ts';

interface Waiting {
  readonly timeout?: number;
}
type Text = string | RegExp;

const plain = (text: string | null): string => (text ?? '').replaceAll(/\s+/g, ' ').trim();
const meets = (actual: string, wanted: Text): boolean =>
  typeof wanted === 'string' ? actual === plain(wanted) : wanted.test(actual);
const holds = (actual: string, wanted: Text): boolean =>
  typeof wanted === 'string' ? actual.includes(plain(wanted)) : wanted.test(actual);

type Verify = typeof compare | typeof compare.soft;

/** What can be expected of a place; `isNot` turns it round. */
function placed(place: Locator, isNot: boolean, message: string | undefined, verify: Verify) {
  const label = [message, `${isNot ? 'not ' : ''}${place.selector}`].filter(Boolean).join(': ');
  const wait = (check: (judge: typeof compare) => void | Promise<void>, { timeout }: Waiting = {}) =>
    eventually(() => check(compare), timeout).catch(async (error: unknown) => {
      // Said by the one that fails at once, or by the one that goes on.
      if (verify === compare) throw error;
      await check(verify as typeof compare);
    });
  const fitting = (judge: typeof compare, fits: boolean, actual: unknown, wanted: unknown, what: string) => {
    if (isNot) judge(fits, what).toBe(false);
    // Shows where they differ.
    else judge(fits ? wanted : actual, what).toEqual(wanted);
  };
  const state = (name: string, read: (element: HTMLElement) => boolean) => (options?: Waiting) =>
    wait((judge) => judge(read(place.element()), `${label} ${name}`).toBe(!isNot), options);
  const said =
    (read: (element: HTMLElement) => string | null, name: string, fits = meets) =>
    (wanted: Text, options?: Waiting) =>
      wait((judge) => {
        const actual = plain(read(place.element()));
        fitting(judge, fits(actual, wanted), actual, wanted, `${label} ${name}: ${actual}`);
      }, options);
  const matched =
    (name: 'toHaveAccessibleName' | 'toHaveAccessibleDescription') => (wanted: Text, options?: Waiting) =>
      wait((judge) => {
        const judged = judge(place.element(), `${label} ${name}`);
        (isNot ? judged.not : judged)[name](wanted);
      }, options);
  const texts = (wanted: readonly Text[], fits: typeof meets, options?: Waiting) =>
    wait((judge) => {
      const actual = place.elements().map(({ textContent }) => plain(textContent));
      const is = actual.length === wanted.length && actual.every((text, at) => fits(text, wanted[at] ?? ''));
      fitting(judge, is, actual, wanted, label);
    }, options);

  return {
    toBeVisible: (options?: Waiting) =>
      wait((judge) => {
        if (isNot) judge(place.elements().some(isVisible), `${label} is seen`).toBe(false);
        else judge(isVisible(place.element()), `${label} is seen`).toBe(true);
      }, options),
    toBeHidden: (options?: Waiting) =>
      wait((judge) => judge(place.elements().some(isVisible), `${label} is hidden`).toBe(isNot), options),
    toBeAttached: (options?: Waiting) =>
      wait((judge) => judge(place.elements().length > 0, `${label} is there`).toBe(!isNot), options),
    toHaveCount: (count: number, options?: Waiting) =>
      wait((judge) => {
        const judged = judge(place.elements().length, `${label} count`);
        (isNot ? judged.not : judged).toBe(count);
      }, options),
    toHaveText: (wanted: Text | readonly Text[], options?: Waiting) =>
      Array.isArray(wanted)
        ? texts(wanted as readonly Text[], meets, options)
        : said((element) => element.textContent, 'text')(wanted as Text, options),
    toContainText: (wanted: Text, options?: Waiting) =>
      said((element) => element.textContent, 'text', holds)(wanted, options),
    toHaveValue: said((element) => (element as HTMLInputElement).value, 'value'),
    toHaveAttribute: (name: string, wanted?: Text, options?: Waiting) =>
      wanted === undefined
        ? state(`has ${name}`, (element) => element.hasAttribute(name))(options)
        : said((element) => element.getAttribute(name), name)(wanted, options),
    toHaveCSS: (name: string, wanted: Text, options?: Waiting) =>
      said((element) => getComputedStyle(element).getPropertyValue(name), name)(wanted, options),
    toHaveAccessibleName: matched('toHaveAccessibleName'),
    toHaveAccessibleDescription: matched('toHaveAccessibleDescription'),
    toBeFocused: state('has the focus', (element) => element === document.activeElement),
    toBeDisabled: state('is disabled', isDisabled),
    toBeEnabled: state('is enabled', (element) => !isDisabled(element)),
    toBeEditable: state(
      'can be written on',
      (element) => !isDisabled(element) && !(element as HTMLInputElement).readOnly,
    ),
    toBeChecked: state('is checked', isChecked),
    toBeInViewport: ({ ratio = 0, ...options }: Waiting & { readonly ratio?: number } = {}) =>
      wait(async (judge) => {
        const seen = await seenPart(place.element());
        judge(seen > 0 && seen >= ratio, `${label} in sight: ${seen}`).toBe(!isNot);
      }, options),
  };
}

/** From 0, none of it, to 1, all; what clips it counts. */
function seenPart(element: Element): Promise<number> {
  return new Promise((resolve) => {
    const observer = new IntersectionObserver(([entry]) => {
      observer.disconnect();
      resolve(entry?.isIntersecting === true ? Math.max(entry.intersectionRatio, Number.EPSILON) : 0);
    });
    observer.observe(element);
    void realFrame();
  });
}

type Placed = ReturnType<typeof placed>;
type Judged = ReturnType<typeof compare<unknown>>;
type Waited = {
  [K in keyof Judged]: Judged[K] extends (...a: infer A) => unknown ? (...a: A) => Promise<void> : never;
};
interface Expected {
  (place: Locator, message?: string): Placed & { readonly not: Placed };
  <T>(value: T, message?: string): ReturnType<typeof compare<T>>;
}

const expectWith = (verify: Verify): Expected =>
  ((value: unknown, message?: string) =>
    value instanceof Locator
      ? { ...placed(value, false, message, verify), not: placed(value, true, message, verify) }
      : verify(value, message)) as Expected;

/** Every matcher of Vitest, asked again until it holds. */
export function poll<T>(
  read: () => T | Promise<T>,
  options: {
    readonly message?: string;
    readonly timeout?: number;
    readonly intervals?: readonly number[];
  } = {},
): Waited & { readonly not: Waited } {
  const matchers = (isNot: boolean) =>
    new Proxy(
      {},
      {
        get: (_, name: string) =>
          name === 'not'
            ? matchers(true)
            : (...wanted: unknown[]) =>
                eventually(async () => {
                  const judged = compare(await read(), options.message) as unknown as Record<
                    string,
                    (...wanted: unknown[]) => void
                  >;
                  const chosen = isNot ? (judged.not as unknown as typeof judged) : judged;
                  chosen[name]?.(...wanted);
                }, options.timeout),
      },
    );
  return matchers(false) as Waited & { readonly not: Waited };
}

const soft = Object.assign(expectWith(compare.soft), { poll });

export const expect = Object.assign(expectWith(compare), {
  poll,
  soft,
  stringContaining: (part: string): unknown => compare.stringContaining(part),
  configure: ({ soft: isSoft = false }: { readonly soft?: boolean }) => (isSoft ? soft : expect),
});
