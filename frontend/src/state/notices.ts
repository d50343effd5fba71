// Short messages on the page. Information disappears after some seconds; warnings and errors stay until they are dismissed
// or replaced by the same message. Knows no link and no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import { RangeRefusal } from '#shared/codec/encode.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import { linkSentence, rangeText } from '../i18n/sentences.ts';

export type NoticeTone = 'info' | 'warning' | 'danger';

/** An offer beside the message; it can be used once. */
export interface NoticeAction {
  readonly label: string;
  act(): void;
}

export interface Notice {
  readonly id: number;
  readonly tone: NoticeTone;
  readonly text: string;
  /** Of an error. */
  readonly code?: LinkErrorCode | undefined;
  /** It holds for the board that is connected, and for no other. */
  readonly isOfBoard: boolean;
  readonly action?: NoticeAction | undefined;
}

export interface Notices {
  readonly store: StoreApi<readonly Notice[]>;
  /** The latest visual change in words, for screen readers. */
  readonly said: StoreApi<string>;
  say(text: string): void;
  show(tone: NoticeTone, text: string, action?: NoticeAction): void;
  /** Says why a field rejects an input. Returns a function that removes the message. */
  refuse(text: string): () => void;
  /** Messages about the board that is connected, until `boardLeft`. */
  readonly ofBoard: Pick<Notices, 'show' | 'showError'>;
  /** Another board is connected: messages about the one before are removed. */
  boardLeft(): void;
  /** Removes a message that no longer applies. */
  takeBack(text: string): void;
  /** Removes the messages about such errors. */
  takeBackErrors(codes: readonly LinkErrorCode[]): void;
  /** Shows an error as a sentence. A cancelled operation is no error. */
  showError(error: unknown): void;
  dismiss(id: number): void;
}

const INFO_STAYS_MS = 6000;
const MAX_SHOWN = 3;

export function createNotices(clock: Clock): Notices {
  const store = createStore<readonly Notice[]>(() => []);
  const said = createStore(() => '');
  let nextId = 1;

  function add(next: Omit<Notice, 'id'>): void {
    const id = nextId++;
    remove(({ text }) => text === next.text);
    store.setState((notices) => [...notices, { id, ...next }].slice(-MAX_SHOWN), true);
    if (next.tone === 'info') clock.after(INFO_STAYS_MS, () => dismiss(id));
  }

  function remove(isOld: (notice: Notice) => boolean): void {
    store.setState((notices) => notices.filter((notice) => !isOld(notice)), true);
  }

  const show: Notices['show'] = (tone, text, action) => add({ tone, text, action, isOfBoard: false });
  const dismiss = (shown: number): void => remove(({ id }) => id === shown);
  const takeBack = (old: string): void => remove(({ text }) => text === old);

  function showError(error: unknown, isOfBoard = false): void {
    const { code, message, cause, heldBy } = asLinkError(error);
    const detail = cause instanceof RangeRefusal ? rangeText(cause) : message;
    if (code === 'cancelled') return;
    const text = linkSentence({ code, message: detail, heldBy });
    add({ tone: code === 'internal' ? 'danger' : 'warning', text, code, isOfBoard });
  }

  return {
    ...{ store, said, show, takeBack },
    ofBoard: {
      show: (tone, text, action) => add({ tone, text, action, isOfBoard: true }),
      showError: (error) => showError(error, true),
    },
    boardLeft: () => remove(({ isOfBoard }) => isOfBoard),
    refuse(text) {
      show('warning', text);
      return () => takeBack(text);
    },
    takeBackErrors: (codes) => remove(({ code }) => code !== undefined && codes.includes(code)),
    say: (text) => said.setState(text, true),
    showError: (error) => showError(error),
    dismiss,
  };
}

function asLinkError(error: unknown): LinkError {
  if (error instanceof LinkError) return error;
  return new LinkError('internal', error instanceof Error ? error.message : String(error));
}
