// Times on a group's timeline in digits, the same in every language. Apart from numbers.ts, which is in the first load.

const formats = [0, 1, 2, 3].map(
  (decimals) =>
    new Intl.NumberFormat('en', {
      useGrouping: false,
      minimumFractionDigits: decimals,
      maximumFractionDigits: decimals,
    }),
);

const fixed = (value: number, decimals: number): string => formats[decimals]?.format(value) ?? '';

/** `1.50`, or with three decimals where hundredths would hide something. */
export const secondsText = (atMs: number): string => fixed(atMs / 1000, atMs % 10 === 0 ? 2 : 3);

/** With as many decimals as the ruler's step has; from a minute on as `1:05`. */
export function markText(atMs: number, stepMs: number): string {
  const decimals = [1000, 100, 10, 1].findIndex((part) => stepMs % part === 0);
  if (atMs < 60_000) return fixed(atMs / 1000, decimals);
  const seconds = fixed((atMs % 60_000) / 1000, decimals);
  return `${Math.floor(atMs / 60_000)}:${atMs % 60_000 < 10_000 ? '0' : ''}${seconds}`;
}
