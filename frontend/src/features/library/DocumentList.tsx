// The cards of the library: filtered, sorted, in rows of which only the visible ones are rendered. Arrow keys go from picture to picture;
// one card at a time is unfolded.

import {
  useLayoutEffect,
  useState,
  type RefObject,
  useCallback,
  useEffect,
  useEffectEvent,
  useMemo,
  useRef,
  type FocusEvent,
  type KeyboardEvent,
} from 'react';
import { defaultRangeExtractor, useVirtualizer } from '@tanstack/react-virtual';
import type { Listed } from '#shared/files/documentStore.ts';
import { neighbour } from '../../ui/cards.ts';
import { words } from '../../i18n/whole.ts';
import { DocumentCard } from './DocumentCard.tsx';
import styles from './Library.module.css';

/** Assumed height of a row with a line of tags, until it is measured. */
const ROW_PX = 244;
/** The same as in the style sheet. */
const GAP_PX = 12;
const BESIDE = 2;

interface VisibleRow {
  readonly index: number;
  /** Height of the rows that are skipped before this one. */
  readonly roomBeforePx: number;
}

interface VisibleRows {
  readonly rows: readonly VisibleRow[];
  readonly roomBehindPx: number;
  /** For one card of each row. All cards have `data-index`, because the first of a row depends on the list's width. */
  measure(card: Element | null): void;
}

/**
 * The rows in sight, some beside them and the one with the focus, so that hundreds of cards cost only what is visible. `keys`: a name per
 * row, to remember its height. `focused`: the row with the focus, -1 for none.
 */
function useVisibleRows(
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

interface DocumentListProps {
  readonly documents: readonly Listed[];
  readonly nowMs: number;
  onDone(): void;
}

export function DocumentList(props: DocumentListProps) {
  if (props.documents.length === 0) return <p className={styles.empty}>{words.library.nothingFound}</p>;
  return <Cards {...props} />;
}

function Cards({ documents, nowMs, onDone }: DocumentListProps) {
  const list = useRef<HTMLUListElement>(null);
  const [unfolded, setUnfolded] = useState<string | null>(null);
  const unfold = useCallback((id: string, isUnfolded: boolean) => setUnfolded(isUnfolded ? id : null), []);
  const columns = useColumns(list);
  const rows = useMemo(() => cardRows(documents, columns, unfolded), [documents, columns, unfolded]);
  const keys = useMemo(() => rows.map(([first]) => first?.id ?? ''), [rows]);
  const places = useMemo(() => new Map(documents.map(({ id }, index) => [id, index])), [documents]);
  const { focused, hold, walk } = useWalk(list, documents);
  const focusedRow = rows.findIndex((row) => row.some(({ id }) => id === focused));
  const { rows: visible, roomBehindPx, measure } = useVisibleRows(list, keys, focusedRow);
  return (
    <ul ref={list} className={styles.list} aria-label={words.library.list} onKeyDown={walk} onFocus={hold}>
      {visible.flatMap(({ index, roomBeforePx }) => [
        <Room key={`before ${index}`} heightPx={roomBeforePx} />,
        ...(rows[index] ?? []).map((document, column) => (
          <DocumentCard
            key={document.id}
            {...(column === 0 && { ref: measure })}
            row={index}
            place={(places.get(document.id) ?? 0) + 1}
            count={documents.length}
            document={document}
            nowMs={nowMs}
            isUnfolded={document.id === unfolded}
            onUnfold={unfold}
            onDone={onDone}
          />
        )),
      ])}
      <Room heightPx={roomBehindPx} />
    </ul>
  );
}

/** The space of cards that are not rendered. */
function Room({ heightPx }: { readonly heightPx: number }) {
  return heightPx > 0 && <li aria-hidden="true" className={styles.room} style={{ height: heightPx }} />;
}

/** The number of columns that the style sheet lays out. */
function useColumns(list: RefObject<HTMLElement | null>): number {
  const [columns, setColumns] = useState(1);
  useLayoutEffect(() => {
    const element = list.current;
    if (element === null) return undefined;
    const measure = (): void => setColumns(getComputedStyle(element).gridTemplateColumns.split(' ').length);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [list]);
  return columns;
}

interface Walk {
  /** The card that has the focus or had it last. */
  readonly focused: string | null;
  hold(event: FocusEvent): void;
  walk(event: KeyboardEvent): void;
}

/** Arrow keys, Home and End reach each card, rendered or not. */
function useWalk(list: RefObject<HTMLElement | null>, documents: readonly Listed[]): Walk {
  const [focused, setFocused] = useState<string | null>(null);
  const [wish, setWish] = useState(0);
  const focus = useEffectEvent(() => faceOf(list.current, focused)?.focus());
  useEffect(() => {
    if (wish > 0) focus();
  }, [wish]);
  return {
    focused,
    hold: ({ target }) => setFocused(documentOf(target)),
    walk(event) {
      const isFace = event.target instanceof HTMLElement && 'cardFace' in event.target.dataset;
      const index = isFace ? documents.findIndex(({ id }) => id === documentOf(event.target)) : -1;
      const to = index < 0 ? null : neighbour(event.key, index, documents.length);
      if (to === null) return;
      event.preventDefault();
      setFocused(documents[to]?.id ?? null);
      setWish((before) => before + 1);
    },
  };
}

const faceOf = (list: HTMLElement | null, id: string | null): HTMLElement | null =>
  list?.querySelector<HTMLElement>(`[data-document='${CSS.escape(id ?? '')}'] [data-card-face]`) ?? null;

const documentOf = (target: EventTarget): string | null =>
  target instanceof Element
    ? (target.closest('[data-document]')?.getAttribute('data-document') ?? null)
    : null;

interface Card {
  readonly id: string;
}

/** Splits cards into rows of a grid. An unfolded card has a row of its own. */
export function cardRows<One extends Card>(
  cards: readonly One[],
  columns: number,
  unfolded: string | null,
): readonly (readonly One[])[] {
  const rows: One[][] = [];
  let free = 0;
  for (const card of cards) {
    const isWide = card.id === unfolded;
    if (free > 0 && !isWide) rows.at(-1)?.push(card);
    else rows.push([card]);
    if (isWide) free = 0;
    else free = free > 0 ? free - 1 : columns - 1;
  }
  return rows;
}

export const SORTS = ['updated', 'name', 'duration'] as const;
type Sort = (typeof SORTS)[number];

export interface Wish {
  readonly search: string;
  readonly sort: Sort;
  /** Empty for every tag. */
  readonly tag: string;
  /** Documents in the trash instead of the others. */
  readonly isRemoved: boolean;
}

type Order = (one: Listed, other: Listed) => number;

/** Created once: creating it for each comparison would cost more than sorting. */
const { compare } = new Intl.Collator(undefined, { numeric: true });

const byName: Order = (one, other) => compare(one.facts.name, other.facts.name);

const ORDERS: Readonly<Record<Sort, Order>> = {
  updated: (one, other) => other.facts.updatedAtMs - one.facts.updatedAtMs,
  name: byName,
  duration: (one, other) => other.facts.durationMs - one.facts.durationMs,
};

export function arranged(documents: readonly Listed[], wish: Wish): readonly Listed[] {
  const parts = wish.search.toLocaleLowerCase().split(/\s+/u);
  return documents
    .filter(({ isRemoved }) => isRemoved === wish.isRemoved)
    .filter(({ facts }) => wish.tag === '' || facts.tags.includes(wish.tag))
    .filter((document) => parts.every((part) => searchedIn(document).includes(part)))
    .sort((one, other) => ORDERS[wish.sort](one, other) || byName(one, other));
}

/** All tags in alphabetical order. */
export function tagsIn(documents: readonly Listed[]): readonly string[] {
  const tags = documents.filter(({ isRemoved }) => !isRemoved).flatMap(({ facts }) => facts.tags);
  return [...new Set(tags)].sort((one, other) => one.localeCompare(other));
}

const searchedIn = ({ facts }: Listed): string =>
  [facts.name, facts.robot, ...facts.tags].join('\n').toLocaleLowerCase();
