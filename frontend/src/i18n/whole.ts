// All messages in the language in use, and dates, for parts that are loaded after the first load.

import { words as english } from 'virtual:words/en/rest';
import { spoken, type Words as FirstWords } from './words.ts';

const LONGER: readonly (readonly [Intl.RelativeTimeFormatUnit, number])[] = [
  ['day', 86_400_000],
  ['hour', 3_600_000],
  ['minute', 60_000],
];

type Dates = ReturnType<typeof datesIn>;

/** Dates, times and ages. `locale`: as for Intl. */
export function datesIn(locale: string) {
  const timeOfDay = new Intl.DateTimeFormat(locale, { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' });
  const moment = new Intl.DateTimeFormat(locale, {
    dateStyle: 'medium',
    timeStyle: 'short',
    hourCycle: 'h23',
  });
  const elapsed = new Intl.DateTimeFormat(locale, {
    timeZone: 'UTC',
    minute: '2-digit',
    second: '2-digit',
    fractionalSecondDigits: 3,
  });
  const ago = new Intl.RelativeTimeFormat(locale, { style: 'short' });

  return {
    /** `14:05`, from milliseconds since 1970. */
    formatTimeOfDay: (epochMs: number): string => timeOfDay.format(epochMs),
    /** `21 Nov 2026, 14:05`, from milliseconds since 1970. */
    formatMoment: (epochMs: number): string => moment.format(epochMs),
    /** Time since the page was opened, `02:07.345`. */
    formatElapsed: (ms: number): string => elapsed.format(ms),
    /** `3 min. ago`, `2 days ago`, in the largest unit that fits. */
    formatLongAge: (ms: number): string => {
      const [unit, unitMs] = LONGER.find(([, each]) => ms >= each) ?? ['second', 1000];
      return ago.format(-Math.max(0, Math.floor(ms / unitMs)), unit);
    },
    /** `in 12 days`, rounded up in the largest unit that fits. */
    formatLongWait: (ms: number): string => {
      const [unit, unitMs] = LONGER.find(([, each]) => ms >= each) ?? ['second', 1000];
      return ago.format(Math.max(0, Math.ceil(ms / unitMs)), unit);
    },
  };
}

export interface Words extends FirstWords {
  readonly dates: Dates;
}

function wholeOf(now: FirstWords): Words {
  return { ...(now.locale === english.locale ? english : now), dates: datesIn(now.locale) };
}

export let words: Words = wholeOf(spoken.getState());
spoken.subscribe((now) => {
  words = wholeOf(now);
});
