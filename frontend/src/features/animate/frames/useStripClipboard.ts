// Copy, cut and paste of the system while a card of the strip has the focus. The events go to wherever the browser thinks text
// would be, so they are heard for the whole page.

import { useEffect, useEffectEvent, type RefObject } from 'react';
import { useStores } from '../../stores.ts';
import { clipFromText, clipToText } from '../timeline/clipText.ts';
import { copy, cut, paste, togetherNow } from './frameVerbs.ts';
import { cardOf } from './useCards.ts';

/** `changed`: a card may have gone that had the focus. */
export function useStripClipboard(list: RefObject<HTMLElement | null>, changed: () => void): void {
  const stores = useStores();
  const tellChanged = useEffectEvent(changed);
  useEffect(() => {
    const { document } = window;
    const ended = new AbortController();
    const hear = (type: 'copy' | 'cut' | 'paste', act: (data: DataTransfer, id: number) => void): void =>
      document.addEventListener(
        type,
        (event) => {
          const { activeElement } = document;
          const id = list.current?.contains(activeElement) ? cardOf(activeElement, 'data-frame') : null;
          if (id === null || event.clipboardData === null) return;
          act(event.clipboardData, id);
          event.preventDefault();
          tellChanged();
        },
        { signal: ended.signal },
      );
    const put = (data: DataTransfer, clip: ReturnType<typeof copy>): void => {
      if (clip !== null) data.setData('text/plain', clipToText(clip));
    };
    hear('copy', (data, id) => put(data, copy(stores, togetherNow(stores, id))));
    hear('cut', (data, id) => put(data, cut(stores, togetherNow(stores, id))));
    hear('paste', (data) => {
      const text = data.getData('text/plain');
      paste(stores, (text === '' ? null : clipFromText(text)) ?? stores.timeline.getState().clip);
    });
    return () => ended.abort();
  }, [stores, list]);
}
