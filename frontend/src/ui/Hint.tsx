// The tooltip of an element, with its text and its key, open while it is rendered; and chords as they are written on the keys, for menus and
// the list of all actions too. Not in the first load.

import type { RefObject } from 'react';
import { Tooltip, TooltipTriggerStateContext } from 'react-aria-components/Tooltip';
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

const SIGNS: Readonly<Record<string, string>> = {
  ...{ ' ': 'Space', Escape: 'Esc', PageUp: 'Page Up', PageDown: 'Page Down' },
  ...{ ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓' },
};

/** As it is written on the keys. */
export function chordText(chord: string): string {
  const { held, key } = partsOf(chord);
  const name = SIGNS[key] ?? (/^\p{Ll}$/u.test(key) ? key.toUpperCase() : key);
  return [...held, name].join('+');
}

function partsOf(chord: string): { readonly held: readonly string[]; readonly key: string } {
  const held = /^(?:(?:Ctrl|Alt|Shift)\+)*/u.exec(chord)?.[0] ?? '';
  return { held: held.split('+').slice(0, -1), key: chord.slice(held.length) };
}
