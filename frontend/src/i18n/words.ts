// The messages that the first load needs, in the language in use; all others are in whole.ts. English is built in, other languages are
// loaded on demand. Read messages while rendering, never when a module is loaded: the language can change at any time.

import { words as english } from 'virtual:words/en/first';
import { createStore, useStore } from 'zustand';
import type { Numbers } from './numbers.ts';
import type { Messages } from './words.generated.ts';
import { useEffect } from 'react';

/** The messages of a language, and how it writes numbers. */
export interface Words extends Messages {
  readonly numbers: Numbers;
}

interface LanguageEntry {
  /** The language's own name. */
  readonly name: string;
  /** English is part of the page. */
  readonly load: () => Promise<{ readonly words: Words }>;
}

/** A further language is a file of messages beside en.json, and a line here. */
export const LANGUAGES = {
  en: { name: 'English', load: () => Promise.resolve({ words: english }) },
  zh: { name: '中文', load: () => import('virtual:words/zh') },
} as const satisfies Readonly<Record<string, LanguageEntry>>;

export type Language = keyof typeof LANGUAGES;
export const LANGUAGE_CODES = Object.keys(LANGUAGES) as readonly Language[];

/** The preferred one of our languages; `tags` as in `navigator.languages`. */
export function preferredLanguage(tags: readonly string[]): Language {
  const wanted = tags.map((tag) => tag.split('-')[0]?.toLowerCase() ?? '');
  return wanted.find((name): name is Language => Object.hasOwn(LANGUAGES, name)) ?? 'en';
}

export let words: Words = english;

export const spoken = createStore(() => english);
spoken.subscribe((now) => {
  words = now;
});

let wanted: Language = 'en';

/** Switches the language. Rejects if it cannot be loaded; then nothing changes. Of several concurrent calls the last one wins. */
export async function speak(language: Language): Promise<void> {
  wanted = language;
  const loaded = await LANGUAGES[language].load();
  if (wanted === language) spoken.setState(loaded.words, true);
}

/** Renders the component again when the language changes, with its children. For the page and for memoised components. */
export const useWords = (): Words => useStore(spoken);

/** The locale in use. Sets the document's language, and renders its component again when the language changes. */
export function useSpokenLocale(): string {
  const { locale } = useWords();
  useEffect(() => {
    document.documentElement.lang = locale;
  }, [locale]);
  return locale;
}
