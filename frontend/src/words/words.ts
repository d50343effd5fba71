// The words in use that the first load needs; for the others see whole.ts. English from the start, another language once it is spoken,
// which is loaded then. They are read while something is drawn, never when its module is loaded: they change under a running page.

import { createStore, useStore } from 'zustand';
import { english, type FirstWords } from './en/english.ts';
import type { Words } from './en/whole.ts';

export type { FirstWords };

export const LANGUAGES = ['en', 'zh'] as const;
export type Language = (typeof LANGUAGES)[number];

/** What a language is called by those who speak it. */
export const OWN_NAMES: Readonly<Record<Language, { readonly name: string; readonly locale: string }>> = {
  en: { name: 'English', locale: 'en' },
  zh: { name: '中文', locale: 'zh-CN' },
};

/** What is spoken; `whole` null: English, whose other words come with the parts that say them. */
interface Spoken {
  readonly words: FirstWords;
  readonly whole: Words | null;
}

const ENGLISH: Spoken = { words: english, whole: null };

const WORDS: Readonly<Record<Language, () => Promise<Spoken>>> = {
  en: () => Promise.resolve(ENGLISH),
  async zh() {
    const { chinese } = await import('./zh/chinese.ts');
    return { words: chinese, whole: chinese };
  },
};

/** The language a browser prefers among ours; `tags` as in `navigator.languages`, the dearest first. */
export function preferredLanguage(tags: readonly string[]): Language {
  const wanted = tags.map((tag) => tag.split('-')[0]?.toLowerCase());
  return wanted.map((name) => LANGUAGES.find((language) => language === name)).find(Boolean) ?? 'en';
}

export let words: FirstWords = english;

export const spoken = createStore<Spoken>(() => ENGLISH);
spoken.subscribe((now) => {
  words = now.words;
});

let wanted: Language = 'en';

/** Rejects where the words cannot be loaded; then those in use stay. Of several at once the last one is spoken. */
export async function speak(language: Language): Promise<void> {
  wanted = language;
  const next = await WORDS[language]();
  if (wanted === language) spoken.setState(next);
}

/** Draws its component again in each new language; its children follow. For the page, and whatever is drawn only as it changes. */
export const useWords = (): FirstWords => useStore(spoken).words;
