// Numbers and units as people read them, through Intl. Knows no sentence.

const language = 'en';
const whole = new Intl.NumberFormat(language, { useGrouping: false });
const degrees = [0, 1].map(
  (digits) =>
    new Intl.NumberFormat(language, {
      useGrouping: false,
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
      signDisplay: 'negative',
    }),
);
const volts = new Intl.NumberFormat(language, { minimumFractionDigits: 2, maximumFractionDigits: 2 });
const tickVolts = new Intl.NumberFormat(language, { minimumFractionDigits: 1, maximumFractionDigits: 1 });
const timeOfDay = new Intl.DateTimeFormat(language, { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' });
const seconds = new Intl.NumberFormat(language, {
  style: 'unit',
  unit: 'second',
  minimumFractionDigits: 1,
  maximumFractionDigits: 1,
});
const percent = new Intl.NumberFormat(language, { style: 'percent', maximumFractionDigits: 0 });
const grouped = new Intl.NumberFormat(language);
const ago = new Intl.RelativeTimeFormat(language, { style: 'short' });
const list = new Intl.ListFormat(language);
const elapsed = new Intl.DateTimeFormat(language, {
  timeZone: 'UTC',
  minute: '2-digit',
  second: '2-digit',
  fractionalSecondDigits: 3,
});

export type PositionUnit = 'us' | 'steps';

/** Digits only, never grouped: positions stand in columns. */
export const formatWhole = (value: number): string => whole.format(value);
/** 0 to 1. */
export const formatPercent = (share: number): string => percent.format(share);
export const formatCount = (value: number): string => grouped.format(value);
export const formatList = (values: readonly number[]): string => list.format(values.map(formatWhole));
export const formatNames = (names: readonly string[]): string => list.format(names);
export const unitSymbol = (unit: PositionUnit): string => (unit === 'us' ? 'µs' : 'steps');
export const formatPosition = (position: number, unit: PositionUnit): string =>
  `${whole.format(position)} ${unitSymbol(unit)}`;
export const formatDegrees = (value: number, decimals: 0 | 1): string =>
  `${degrees[decimals]?.format(value)}°`;
/** Volts are no unit of Intl's list, so the symbol is written here. */
export const formatVolts = (millivolts: number): string => `${volts.format(millivolts / 1000)}\u00a0V`;
/** On an axis: volts without their symbol. */
export const formatTick = (volts: number): string => tickVolts.format(volts);
/** `14:05`, from milliseconds since 1970. */
export const formatTimeOfDay = (epochMs: number): string => timeOfDay.format(epochMs);
export const formatSeconds = (ms: number): string => seconds.format(ms / 1000);
export const formatMs = (ms: number): string => `${whole.format(ms)} ms`;

/** `3 sec. ago`, by whole seconds and above a minute by minutes. */
export function formatAge(ms: number): string {
  const ageSeconds = Math.max(0, Math.round(ms / 1000));
  return ageSeconds < 60
    ? ago.format(-ageSeconds, 'second')
    : ago.format(-Math.round(ageSeconds / 60), 'minute');
}

/** Time since the page was opened, `02:07.345`. */
export const formatElapsed = (ms: number): string => elapsed.format(ms);
