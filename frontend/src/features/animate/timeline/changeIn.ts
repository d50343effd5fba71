// A number that is typed with a sign before it: not a new one, but what becomes of the one that is there. A minus alone begins a
// number below zero. Pure.

import { numberIn } from '../../../ui/NumberField.tsx';

const CHANGE = /^(\+=?|[-−]=|[*×/÷])(.+)$/u;
/** Of a factor. */
const EXACT = 3;

const BY: Readonly<Record<string, (by: number) => (value: number) => number>> = {
  '+': (by) => (value) => value + by,
  '-': (by) => (value) => value - by,
  '*': (by) => (value) => value * by,
  '/': (by) => (value) => value / by,
};
const SIGNS: Readonly<Record<string, string>> = { '−': '-', '×': '*', '÷': '/' };

/** `+10`, `-=10`, `*1.2`, `/2`; null where it is no change. */
export function changeIn(text: string, decimals: 0 | 1): ((value: number) => number) | null {
  const [, sign = '', written = ''] = CHANGE.exec(text.replaceAll(/\s/gu, '')) ?? [];
  const name = SIGNS[sign.charAt(0)] ?? sign.charAt(0);
  const isFactor = name === '*' || name === '/';
  const by = isFactor
    ? Number(Number(written.replace(',', '.')).toFixed(EXACT))
    : numberIn(written, decimals);
  const isMeant = written !== '' && Number.isFinite(by) && !(name === '/' && by === 0);
  return isMeant ? (BY[name]?.(by) ?? null) : null;
}
