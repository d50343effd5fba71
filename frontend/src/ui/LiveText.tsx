// A text that changes by itself, written past React: at most once a frame, or no more often than it can be read, and only
// where it has become another one.

import { useLayoutEffect, useRef } from 'react';
import { turnOf, useEachFrame } from './useEachFrame.ts';

export interface LiveTextProps {
  /** Asked for what is to stand there now. */
  text(): string;
  readonly eachMs?: number;
  readonly className?: string | undefined;
  readonly title?: string;
  /** It changes all the time, and something else says it to screen readers. */
  readonly isSilent?: boolean;
}

export function LiveText({ text, eachMs = 0, className, title, isSilent = false }: LiveTextProps) {
  const place = useRef<HTMLSpanElement>(null);
  const written = useRef({ text: '', atMs: -Infinity });

  function write(atMs: number): void {
    const now = text();
    if (place.current !== null && now !== written.current.text) place.current.textContent = now;
    written.current = { text: now, atMs };
  }

  useLayoutEffect(() => write(performance.now() - turnOf(eachMs)));
  useEachFrame(() => {
    const atMs = performance.now();
    if (atMs - written.current.atMs >= eachMs) write(atMs);
  });
  return <span ref={place} className={className} title={title} aria-hidden={isSilent ? true : undefined} />;
}
