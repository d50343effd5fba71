// The tooltip of an element. Open while it is rendered.

import type { RefObject } from 'react';
import { Tooltip, TooltipTriggerStateContext } from 'react-aria-components/Tooltip';
import { InLanguage } from './InLanguage.tsx';
import styles from './Hints.module.css';

interface HintProps {
  readonly text: string;
  readonly of: RefObject<Element | null>;
  onClose(): void;
}

export function Hint({ text, of, onClose }: HintProps) {
  const state = { isOpen: true, shouldSkipAnimation: true, open: () => undefined, close: onClose };
  return (
    <InLanguage>
      <TooltipTriggerStateContext value={state}>
        <Tooltip key={text} triggerRef={of} className={styles.hint ?? ''} offset={6}>
          {text}
        </Tooltip>
      </TooltipTriggerStateContext>
    </InLanguage>
  );
}
