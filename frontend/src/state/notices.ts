// Short messages on the page. Information disappears after some seconds; warnings and errors stay until they are dismissed
// or replaced by the same message. Knows no link and no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import { RangeRefusal } from '#shared/codec/encode.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { errorSentence, rangeText } from '../i18n/sentences.ts';

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
  readonly action?: NoticeAction | undefined;
}

export interface Notices {
  readonly store: StoreApi<readonly Notice[]>;
  /** The latest visual change in words, for screen readers. */
  readonly said: StoreApi<string>;
  say(text: string): void;
  tell(tone: NoticeTone, text: string, action?: NoticeAction): void;
  /** Says why a field rejects an input. Returns a function that removes the message. */
  refuse(text: string): () => void;
  /** Removes a message that no longer applies. */
  takeBack(text: string): void;
  /** Shows an error as a sentence. A cancelled operation is no error. */
  tellError(error: unknown): void;
  dismiss(id: number): void;
}

const INFO_STAYS_MS = 6000;
const MAX_SHOWN = 3;

export function createNotices(clock: Clock): Notices {
  const store = createStore<readonly Notice[]>(() => []);
  const said = createStore(() => '');
  let nextId = 1;

  function tell(tone: NoticeTone, text: string, action?: NoticeAction): void {
    const id = nextId++;
    const others = store.getState().filter((notice) => notice.text !== text);
    store.setState([...others, { id, tone, text, action }].slice(-MAX_SHOWN), true);
    if (tone === 'info') clock.after(INFO_STAYS_MS, () => dismiss(id));
  }

  function dismiss(id: number): void {
    store.setState((notices) => notices.filter((notice) => notice.id !== id), true);
  }

  function takeBack(text: string): void {
    store.setState((notices) => notices.filter((notice) => notice.text !== text), true);
  }

  return {
    ...{ store, said, tell, takeBack },
    refuse(text) {
      tell('warning', text);
      return () => takeBack(text);
    },
    say: (text) => said.setState(text, true),
    tellError(error) {
      const { code, message, cause } = asLinkError(error);
      const detail = cause instanceof RangeRefusal ? rangeText(cause) : message;
      if (code !== 'cancelled') tell(code === 'internal' ? 'danger' : 'warning', errorSentence(code, detail));
    },
    dismiss,
  };
}

function asLinkError(error: unknown): Pick<LinkError, 'code' | 'message' | 'cause'> {
  if (error instanceof LinkError) return error;
  return { code: 'internal', message: error instanceof Error ? error.message : String(error) };
}
