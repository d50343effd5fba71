// Which cell of the grid the keys are at, for ears. Only one that is there may be named: where the key itself is out of sight it is
// its row, and where that is, too, none. Cells come and go with every scroll, so this looks whenever they do.

import { useLayoutEffect, type RefObject } from 'react';
import { useTimeline } from '../../stores.ts';
import { cellId } from './Rows.tsx';

const NAMES = 'aria-activedescendant';

export function useActiveCell(grid: RefObject<HTMLElement | null>, id: string): void {
  const cell = useTimeline(({ cursor }) => cellId(id, cursor.row, cursor.frameId));
  const row = useTimeline(({ cursor }) => cellId(id, cursor.row, null));
  useLayoutEffect(() => {
    const { current } = grid;
    if (current === null) return undefined;
    const name = (): void => {
      const there = [cell, row].find((one) => window.document.getElementById(one) !== null);
      if (there === undefined) current.removeAttribute(NAMES);
      else if (current.getAttribute(NAMES) !== there) current.setAttribute(NAMES, there);
    };
    name();
    const observer = new MutationObserver(name);
    observer.observe(current, { childList: true, subtree: true });
    return () => observer.disconnect();
  }, [grid, cell, row]);
}
