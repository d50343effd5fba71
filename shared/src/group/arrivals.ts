// What becomes of groups on their way to the board, by what is told of the download: whoever asked for them may have been away.
// Pure; knows the book, no session.

import { withStored, withUnknown, type SlotBook, type SlotRecord } from './slotBook.ts';

/** The latest download, by whomever. */
export interface DownloadNews {
  readonly slots: readonly number[];
  readonly groupsStored: number;
  readonly isOver: boolean;
}

interface Fates {
  readonly arrived: readonly SlotRecord[];
  /** Nobody knows what their slots hold now. */
  readonly gone: readonly SlotRecord[];
  readonly waiting: readonly SlotRecord[];
}

/** These are on their way: the first byte has left. */
export const withBegun = (book: SlotBook, begun: readonly SlotRecord[]): SlotBook => ({ ...book, begun });

export const isAbout = ({ slots }: DownloadNews, { begun }: SlotBook): boolean =>
  begun.length > 0 && begun.every(({ slot }) => slots.includes(slot));

/** `news` null: nobody has heard of a download. `broken`: slots that hold half a group. */
export function withNews(book: SlotBook, news: DownloadNews | null, broken: readonly number[]): SlotBook {
  const { begun } = book;
  if (begun.length === 0) return book;
  const isTold = news !== null && isAbout(news, book);
  const { arrived, gone, waiting } = isTold ? toldFates(begun, news, broken) : guessedFates(begun, broken);
  if (waiting.length === begun.length) return book;
  const forgotten = gone.reduce((sum, { slot }) => withUnknown(sum, slot), book);
  return { ...arrived.reduce(withStored, forgotten), begun: waiting };
}

/** Behind the one that broke none was begun, and what such a slot held before it holds still. */
function toldFates(begun: readonly SlotRecord[], news: DownloadNews, broken: readonly number[]): Fates {
  const isStored = ({ slot }: SlotRecord): boolean => news.slots.indexOf(slot) < news.groupsStored;
  const others = begun.filter((record) => !isStored(record));
  return {
    arrived: begun.filter(isStored),
    gone: news.isOver ? others.filter(({ slot }) => broken.includes(slot)) : [],
    waiting: news.isOver ? [] : others,
  };
}

/**
 * They go one after the other: what stands before a broken one has arrived. Where none broke, the first one has, which was
 * under way; of the others nobody can say.
 */
function guessedFates(begun: readonly SlotRecord[], broken: readonly number[]): Fates {
  const at = begun.findIndex(({ slot }) => broken.includes(slot));
  return at === -1
    ? { arrived: begun.slice(0, 1), gone: begun.slice(1), waiting: [] }
    : { arrived: begun.slice(0, at), gone: begun.slice(at, at + 1), waiting: [] };
}
