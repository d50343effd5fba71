// Tooltips on hover and keyboard focus for all elements with a hint. The page has one tooltip for all of them: one per button would add a
// third to the cost of each.

import { useEffect, useRef, useState } from 'react';
import { attach, hintOf, type HintText } from './hinting.ts';
import { later, usePart } from './later.tsx';

const tooltip = later(async () => (await import('./Hint.tsx')).Hint);

export function Hints() {
  const [hint, setHint] = useState<HintText | null>(null);
  const element = useRef<Element | null>(null);
  const hide = useRef((): void => undefined);
  useEffect(() => {
    const hints = attach(document, (shown) => {
      element.current = shown;
      if (shown === null) return setHint(null);
      const next = hintOf(shown);
      setHint(next);
      // A screen reader says the element's name anyway.
      const text = next.text === shown.getAttribute('aria-label') ? '' : next.text;
      const said = [text, next.whyNot].filter((part) => part !== '').join(' ');
      if (said !== '') shown.setAttribute('aria-description', said);
    });
    hide.current = hints.hide;
    return hints.detach;
  }, []);
  const { part: Hint } = usePart(tooltip, hint !== null);
  if (hint === null || Hint === null) return null;
  return <Hint {...hint} of={element} onClose={() => hide.current()} />;
}
