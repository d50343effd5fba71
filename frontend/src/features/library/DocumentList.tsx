// The cards of the library. Arrow keys lead from picture to picture; one card at a time lies open.

import {
  useCallback,
  useEffect,
  useEffectEvent,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
  type FocusEvent,
  type KeyboardEvent,
  type RefObject,
} from 'react';
import type { Listed } from '#shared/files/keeper.ts';
import { neighbour } from '../animate/frames/neighbour.ts';
import { words } from '../../i18n/whole.ts';
import { cardRows } from './cardRows.ts';
import { DocumentCard } from './DocumentCard.tsx';
import { useVisibleRows } from './useVisibleRows.ts';
import styles from './Library.module.css';

export interface DocumentListProps {
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

/** Where cards that are not drawn would be. */
function Room({ heightPx }: { readonly heightPx: number }) {
  return heightPx > 0 && <li aria-hidden="true" className={styles.room} style={{ height: heightPx }} />;
}

/** As many as the style sheet finds room for. */
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
  /** The card in which the focus is, or was last. */
  readonly focused: string | null;
  hold(event: FocusEvent): void;
  walk(event: KeyboardEvent): void;
}

/** Arrow keys, Home and End lead to each card, drawn or not. */
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
