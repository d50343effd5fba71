// Short explanations that show on hover and on keyboard focus, of whatever says that it has one. The page has one tooltip for all
// of them: one for each button would be drawn with it, a third of what a button costs.

import { useEffect, useRef, useState } from 'react';
import { Tooltip, TooltipTriggerStateContext } from 'react-aria-components/Tooltip';
import { attach, HINT } from './hinting.ts';
import styles from './Hints.module.css';

/** To be spread on what is explained. */
export const hinted = (text: string) => ({ [HINT]: text });

export function Hints() {
  const [text, setText] = useState<string | null>(null);
  const element = useRef<Element | null>(null);
  const hide = useRef((): void => undefined);
  useEffect(() => {
    const hints = attach(document, (shown) => {
      const hint = shown?.getAttribute(HINT) ?? null;
      element.current = shown;
      setText(hint);
      // What is its name is said anyway.
      if (hint !== null && shown?.getAttribute('aria-label') !== hint)
        shown?.setAttribute('aria-description', hint);
    });
    hide.current = hints.hide;
    return hints.detach;
  }, []);
  if (text === null) return null;
  const state = {
    isOpen: true,
    shouldSkipAnimation: true,
    open: () => undefined,
    close: () => hide.current(),
  };
  return (
    <TooltipTriggerStateContext value={state}>
      <Tooltip key={text} triggerRef={element} className={styles.hint ?? ''} offset={6}>
        {text}
      </Tooltip>
    </TooltipTriggerStateContext>
  );
}
