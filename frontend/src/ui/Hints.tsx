// Tooltips on hover and keyboard focus for all elements with a hint. The page has one tooltip for all of them: one per button would add a
// third to the cost of each.

import { useEffect, useRef, useState } from 'react';
import { attach, HINT } from './hinting.ts';
import { later, usePart } from './later.tsx';

const hint = later(async () => (await import('./Hint.tsx')).Hint);

export function Hints() {
  const [text, setText] = useState<string | null>(null);
  const element = useRef<Element | null>(null);
  const hide = useRef((): void => undefined);
  useEffect(() => {
    const hints = attach(document, (shown) => {
      const said = shown?.getAttribute(HINT) ?? null;
      element.current = shown;
      setText(said);
      // A screen reader says the element's name anyway.
      if (said !== null && shown?.getAttribute('aria-label') !== said)
        shown?.setAttribute('aria-description', said);
    });
    hide.current = hints.hide;
    return hints.detach;
  }, []);
  const { part: Hint } = usePart(hint, text !== null);
  if (text === null || Hint === null) return null;
  return <Hint text={text} of={element} onClose={() => hide.current()} />;
}
