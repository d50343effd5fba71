// Which rows of a long grid of cards are drawn: those in sight, some beside them and the one with the focus, so that hundreds of cards
// cost what is seen of them wherever the list is scrolled to. The room of all others is kept. Knows no card.

import { useLayoutEffect, useState, type RefObject } from 'react';
import { defaultRangeExtractor, useVirtualizer } from '@tanstack/react-virtual';

/** A row of the library with a line of tags, until it has been measured. */
const ROW_PX = 244;
/** As in the style sheet. */
const GAP_PX = 12;
const BESIDE = 2;

export interface VisibleRow {
  readonly index: number;
  /** Between the row drawn before it and this one; 0 where they follow each other. */
  readonly roomBeforePx: number;
}

export interface VisibleRows {
  readonly rows: readonly VisibleRow[];
  readonly roomBehindPx: number;
  /** For one card of each row. All carry `data-index`: in a list of other width another one is first. */
  measure(card: Element | null): void;
}

/** `keys`: a name for each row, by which its height is remembered. `focused`: the row that stays, wherever it is; -1: none. */
export function useVisibleRows(
  list: RefObject<HTMLElement | null>,
  keys: readonly string[],
  focused: number,
): VisibleRows {
  const [marginPx, setMarginPx] = useState(0);
  // oxlint-disable-next-line react/incompatible-library -- it is about React's compiler, which the page is built without
  const virtualizer = useVirtualizer<Element, Element>({
    ...{ count: keys.length, overscan: BESIDE, gap: GAP_PX, scrollMargin: marginPx },
    estimateSize: () => ROW_PX,
    getItemKey: (index) => keys[index] ?? index,
    getScrollElement: () => scrollerOf(list.current),
    rangeExtractor: (range) =>
      focused < 0
        ? defaultRangeExtractor(range)
        : [...new Set([...defaultRangeExtractor(range), focused])].sort((one, other) => one - other),
  });

  useLayoutEffect(() => {
    const [element, scroller] = [list.current, scrollerOf(list.current)];
    if (element === null || scroller === null) return undefined;
    const measure = (): void => {
      const topPx = element.getBoundingClientRect().top - scroller.getBoundingClientRect().top;
      setMarginPx(Math.round(topPx + scroller.scrollTop));
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    observer.observe(scroller);
    return () => observer.disconnect();
  }, [list]);

  const items = virtualizer.getVirtualItems();
  const roomBetween = (fromPx: number, toPx: number): number => Math.max(0, toPx - fromPx - GAP_PX);
  return {
    rows: items.map(({ index, start }, place) => ({
      index,
      roomBeforePx: roomBetween(items[place - 1]?.end ?? marginPx - GAP_PX, start - GAP_PX),
    })),
    roomBehindPx: roomBetween(items.at(-1)?.end ?? marginPx, marginPx + virtualizer.getTotalSize()),
    measure: virtualizer.measureElement,
  };
}

function scrollerOf(element: Element | null): Element | null {
  const above = element?.parentElement ?? null;
  if (above === null || /auto|scroll/.test(getComputedStyle(above).overflowY)) return above;
  return scrollerOf(above);
}
