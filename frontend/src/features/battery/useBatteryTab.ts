// A low battery in the browser's tab: in the title and as the icon, for whoever looks at another page. Gone when it is fine.

import { useEffect } from 'react';
import { isPlain, type Level } from '#shared/profile/battery.ts';
import { useBattery, useSnapshot } from '../stores.ts';
import { useWords, words } from '../../i18n/words.ts';

/** Fixed colours that are told apart on a light and on a dark tab. */
const FILL: Readonly<Record<Exclude<Level, 'good'>, string>> = { warning: '#b87400', danger: '#d5302a' };

export function useBatteryTab(): void {
  useWords();
  const isLinked = useSnapshot(({ link }) => link.status === 'ready');
  const level = useBattery(({ gauge: { level, last }, supply }) =>
    last !== null && isPlain(last, supply) ? level : null,
  );
  const restMv = useBattery(({ gauge }) => gauge.restMv ?? 0);
  const shown = isLinked && level !== 'good' ? level : null;
  const title =
    shown === null
      ? words.product
      : words.battery.tab({ volts: words.numbers.formatVolts(restMv), product: words.product });
  useEffect(() => {
    document.title = title;
  }, [title]);
  useEffect(() => {
    const link = document.querySelector<HTMLLinkElement>('link[rel="icon"]');
    if (shown === null || link === null) return undefined;
    const usual = link.href;
    link.href = iconOf(FILL[shown]);
    return () => {
      link.href = usual;
    };
  }, [shown]);
}

/** An almost empty cell. */
function iconOf(fill: string): string {
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32"><path fill="none" stroke="${fill}" stroke-width="4" d="M4 8h20v16H4zM28 13v6"/><path fill="${fill}" d="M8 12h4v8H8z"/></svg>`;
  return `data:image/svg+xml,${encodeURIComponent(svg)}`;
}
