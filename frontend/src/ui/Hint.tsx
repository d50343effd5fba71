// The tooltip of an element, with its text and its key. Open while it is rendered.

import type { RefObject } from 'react';
import { Tooltip, TooltipTriggerStateContext } from 'react-aria-components/Tooltip';
import { chordText } from './chordText.ts';
import type { HintText } from './hinting.ts';
import { InLanguage } from './InLanguage.tsx';
import styles from './Hints.module.css';

interface HintProps extends HintText {
  readonly of: RefObject<Element | null>;
  onClose(): void;
}

export function Hint({ text, keys, whyNot, of, onClose }: HintProps) {
  const state = { isOpen: true, shouldSkipAnimation: true, open: () => undefined, close: onClose };
  return (
    <InLanguage>
      <TooltipTriggerStateContext value={state}>
        <Tooltip key={text} triggerRef={of} className={styles.hint ?? ''} offset={6}>
          {text}
          {keys !== '' && <kbd className={styles.keys}>{chordText(keys)}</kbd>}
          {whyNot !== '' && <p className={styles.whyNot}>{whyNot}</p>}
        </Tooltip>
      </TooltipTriggerStateContext>
    </InLanguage>
  );
}
