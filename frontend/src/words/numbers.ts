// Numbers and units as people of a language read them, through Intl. Knows no sentence.

export type PositionUnit = 'us' | 'steps';

/** More servos than that are counted instead. */
export const MOST_NAMED = 8;

const digits = (count: number): Intl.NumberFormatOptions => ({
  minimumFractionDigits: count,
  maximumFractionDigits: count,
});

interface Locale {
  /** As Intl takes it. */
  readonly locale: string;
  /** What a position is counted in; Intl has no steps. */
  readonly units: Readonly<Record<PositionUnit, string>>;
  /** Between a number and its unit. */
  readonly gap: string;
}

const TWO_MINUTES_MS = 120_000;

const LONGER: readonly (readonly [Intl.RelativeTimeFormatUnit, number])[] = [
  ['day', 86_400_000],
  ['hour', 3_600_000],
  ['minute', 60_000],
];

export function numbersIn({ locale, units, gap }: Locale) {
  const whole = new Intl.NumberFormat(locale, { useGrouping: false });
  const twoDigits = new Intl.NumberFormat(locale, { minimumIntegerDigits: 2 });
  const degrees = [0, 1].map(
    (count) =>
      new Intl.NumberFormat(locale, { useGrouping: false, signDisplay: 'negative', ...digits(count) }),
  );
  const volts = new Intl.NumberFormat(locale, digits(2));
  const tickVolts = new Intl.NumberFormat(locale, digits(1));
  const timeOfDay = new Intl.DateTimeFormat(locale, { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' });
  const moment = new Intl.DateTimeFormat(locale, {
    dateStyle: 'medium',
    timeStyle: 'short',
    hourCycle: 'h23',
  });
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
  const when = new Intl.DateTimeFormat(locale, { dateStyle: 'medium', timeStyle: 'short' });
  const elapsed = new Intl.DateTimeFormat(locale, {
    timeZone: 'UTC',
    minute: '2-digit',
    second: '2-digit',
    fractionalSecondDigits: 3,
  });

  /** Digits only, never grouped: positions stand in columns. */
  const formatWhole = (value: number): string => whole.format(value);
  const unitSymbol = (unit: PositionUnit): string => units[unit];

  return {
    formatWhole,
    unitSymbol,
    /** 0 to 1. */
    formatPercent: (share: number): string => percent.format(share),
    formatCount: (value: number): string => grouped.format(value),
    formatList: (values: readonly number[]): string => list.format(values.map(formatWhole)),
    formatNames: (names: readonly string[]): string => list.format(names),
    formatPosition: (position: number, unit: PositionUnit): string =>
      `${formatWhole(position)}${gap}${unitSymbol(unit)}`,
    formatDegrees: (value: number, decimals: 0 | 1): string => `${degrees[decimals]?.format(value)}°`,
    /** Volts are no unit of Intl's list, so the symbol is written here. */
    formatVolts: (millivolts: number): string => `${volts.format(millivolts / 1000)}\u00a0V`,
    /** On an axis: volts without their symbol. */
    formatTick: (volts: number): string => tickVolts.format(volts),
    /** `14:05`, from milliseconds since 1970. */
    formatTimeOfDay: (epochMs: number): string => timeOfDay.format(epochMs),
    /** Day and time, from milliseconds since 1970. */
    formatMoment: (epochMs: number): string => moment.format(epochMs),
    formatSeconds: (ms: number): string => seconds.format(ms / 1000),
    /** Whole seconds, rounded up: for a longest time. */
    formatSecondsUp: (ms: number): string => seconds.format(Math.ceil(ms / 1000)),
    /** `12.5 sec`, from two minutes on `3 min`: of what is known roughly. */
    formatRoughly: (ms: number): string =>
      ms < TWO_MINUTES_MS ? seconds.format(ms / 1000) : minutes.format(Math.round(ms / 60_000)),
    /** `4:05`, rounded up: of what is left. */
    formatMinutes: (ms: number): string => {
      const left = Math.max(0, Math.ceil(ms / 1000));
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

    /** `3 min. ago`, `2 days ago`, in the largest unit that fits. */
    formatLongAge: (ms: number): string => {
      const [unit, unitMs] = LONGER.find(([, each]) => ms >= each) ?? ['second', 1000];
      return ago.format(-Math.max(0, Math.floor(ms / unitMs)), unit);
    },

    /** `21 Nov 2026, 14:05`, from milliseconds since 1970. */
    formatWhen: (epochMs: number): string => when.format(epochMs),

    /** Time since the page was opened, `02:07.345`. */
    formatElapsed: (ms: number): string => elapsed.format(ms),
  };
}
