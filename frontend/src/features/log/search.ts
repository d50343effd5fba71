// Finds a line of the log by words or by bytes. Pure.

import type { LogEntry } from '../../robot/traffic.ts';
import { bytesText, meaning } from './describe.ts';

/** Whole bytes in hex, with or without spaces, are looked for in the bytes; everything in the words. Case is no matter. */
export function searchTest(query: string, locale: string): (entry: LogEntry) => boolean {
  const wanted = query.trim().toLocaleLowerCase(locale);
  if (wanted === '') return () => true;
  const bytes = bytesIn(wanted);
  return (entry) =>
    meaning(entry).toLocaleLowerCase(locale).includes(wanted) ||
    (bytes !== null && bytesText(entry).includes(bytes));
}

function bytesIn(query: string): string | null {
  const digits = query.replace(/\s+/gu, '');
  if (!/^(?:[0-9a-f]{2})+$/u.test(digits)) return null;
  return digits.toUpperCase().replace(/(..)(?!$)/gu, '$1 ');
}
