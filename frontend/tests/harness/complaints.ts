// What a page complains of that is not seen on it: errors and warnings of the console. A test fails on any that it
// did not announce; exceptions fail it by themselves.

import { expect, vi } from 'vitest';

const SERIOUS = ['error', 'warn'] as const;

/** The browser's own remark that it goes on in the next frame; end-to-end tests never hear of it. */
const HARMLESS = /ResizeObserver loop completed/;

export function listenForComplaints() {
  const heard: string[] = [];
  const spies = SERIOUS.map((kind) =>
    vi.spyOn(console, kind).mockImplementation((...said) => {
      heard.push(`${kind}: ${said.map(String).join(' ')}`);
    }),
  );
  return {
    /** Fails unless every complaint so far matches one of `expected`. */
    check(...expected: readonly RegExp[]): void {
      for (const spy of spies) spy.mockRestore();
      expect(
        heard.filter((complaint) => ![HARMLESS, ...expected].some((pattern) => pattern.test(complaint))),
        'the page complained',
      ).toEqual([]);
    },
  };
}
