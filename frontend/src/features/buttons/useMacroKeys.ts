// Keys that start buttons, from anywhere on the page but a field or a dialog. A key counts once until it is let go; when the
// window loses the focus all are, because their release is never heard of.

import { useEffect, useEffectEvent } from 'react';
import { macroKey } from './macroKey.ts';

const TYPING =
  'input:not([type=radio], [type=checkbox], [type=range]), select, textarea, [role=dialog], [role=alertdialog]';

export function useMacroKeys(pressed: (key: string) => void): void {
  const press = useEffectEvent(pressed);
  useEffect(() => {
    const held = new Set<string>();
    const ended = new AbortController();
    const { signal } = ended;
    window.addEventListener('keydown', (event) => down(event, held, press), { signal });
    window.addEventListener('keyup', ({ key }) => held.delete(key.toLowerCase()), { signal });
    window.addEventListener('blur', () => held.clear(), { signal });
    return () => ended.abort();
  }, []);
}

function down(event: KeyboardEvent, held: Set<string>, press: (key: string) => void): void {
  const key = macroKey(event);
  const isTyping = event.target instanceof Element && event.target.closest(TYPING) !== null;
  if (key === null || isTyping || event.defaultPrevented || held.has(key)) return;
  held.add(key);
  press(key);
}
