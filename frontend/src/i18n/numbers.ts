// Numbers and units in a language, through Intl; dates are in whole.ts. Knows no sentence.

const digits = (count: number): Intl.NumberFormatOptions => ({
  minimumFractionDigits: count,
  maximumFractionDigits: count,
});

/** Remaining whole seconds, rounded up. */
export const secondsLeft = (ms: number): number => Math.max(0, Math.ceil(ms / 1000));

const TWO_MINUTES_MS = 120_000;

export type Numbers = ReturnType<typeof numbersIn>;

/** `locale`: as for Intl. */
export function numbersIn(locale: string) {
  const plurals = new Intl.PluralRules(locale);
  const whole = new Intl.NumberFormat(locale, { useGrouping: false });
  const twoDigits = new Intl.NumberFormat(locale, { minimumIntegerDigits: 2 });
  const degrees = [0, 1].map(
    (count) =>
      new Intl.NumberFormat(locale, { useGrouping: false, signDisplay: 'negative', ...digits(count) }),
  );
  const volts = new Intl.NumberFormat(locale, digits(2));
  const tickVolts = new Intl.NumberFormat(locale, digits(1));
  const seconds = new Intl.NumberFormat(locale, { style: 'unit', unit: 'second', ...digits(1) });
  const minutes = new Intl.NumberFormat(locale, { style: 'unit', unit: 'minute' });
  const milliseconds = new Intl.NumberFormat(locale, {
    style: 'unit',
    unit: 'millisecond',
    useGrouping: false,
  });
  const percent = new Intl.NumberFormat(locale, { style: 'percent', maximumFractionDigits: 0 });
  const grouped = new Intl.NumberFormat(locale);
  const ago = new Intl.RelativeTimeFormat(locale, { style: 'short' });
  const list = new Intl.ListFormat(locale);

  /** Digits only, never grouped: positions stand in columns. */
  const formatWhole = (value: number): string => whole.format(value);

  return {
    formatWhole,
    /** Which form of a noun goes with so many. */
    plural: (count: number): Intl.LDMLPluralRule => plurals.select(count),
    /** 0 to 1. */
    formatPercent: (share: number): string => percent.format(share),
    formatCount: (value: number): string => grouped.format(value),
    formatList: (values: readonly number[]): string => list.format(values.map(formatWhole)),
    formatNames: (names: readonly string[]): string => list.format(names),
    formatDegrees: (value: number, decimals: 0 | 1): string => `${degrees[decimals]?.format(value)}°`,
    /** Volts are no unit of Intl's list, so the symbol is written here. */
    formatVolts: (millivolts: number): string => `${volts.format(millivolts / 1000)}\u00a0V`,
    /** On an axis: volts without their symbol. */
    formatTick: (volts: number): string => tickVolts.format(volts),
    formatSeconds: (ms: number): string => seconds.format(ms / 1000),
    /** Whole seconds, rounded up: for a longest time. */
    formatSecondsUp: (ms: number): string => seconds.format(Math.ceil(ms / 1000)),
    /** `12.5 sec`, from two minutes on `3 min`: of what is known roughly. */
    formatRoughly: (ms: number): string =>
      ms < TWO_MINUTES_MS ? seconds.format(ms / 1000) : minutes.format(Math.round(ms / 60_000)),
    /** `4:05`, rounded up: of what is left. */
    formatMinutes: (ms: number): string => {
      const left = secondsLeft(ms);
      return `${whole.format(Math.floor(left / 60))}:${twoDigits.format(left % 60)}`;
    },
    formatMs: (ms: number): string => milliseconds.format(ms),

    /** `3 sec. ago`, by whole seconds, from ten on by tens of them, and above a minute by minutes. */
    formatAge: (ms: number): string => {
      const exactSeconds = Math.max(0, Math.round(ms / 1000));
      const ageSeconds = exactSeconds < 10 ? exactSeconds : 10 * Math.round(exactSeconds / 10);
      return ageSeconds < 60
        ? ago.format(-ageSeconds, 'second')
        : ago.format(-Math.round(ageSeconds / 60), 'minute');
    },
  };
}
