// The words in use: English from the start, another language once it is spoken, which is loaded then. Whoever shows words reads
// them while drawing, never when its module is loaded: they change under a running page.

import { createStore, useStore } from 'zustand';
import { english, type Words } from './en/english.ts';

export type { Words };

export const LANGUAGES = ['en', 'zh'] as const;
export type Language = (typeof LANGUAGES)[number];

/** What a language is called by those who speak it. */
export const OWN_NAMES: Readonly<Record<Language, { readonly name: string; readonly locale: string }>> = {
  en: { name: 'English', locale: 'en' },
  zh: { name: '中文', locale: 'zh-CN' },
};

const WORDS: Readonly<Record<Language, () => Promise<Words>>> = {
  en: () => Promise.resolve(english),
  zh: async () => (await import('./zh/chinese.ts')).chinese,
};

/** The language a browser prefers among ours; `tags` as in `navigator.languages`, the dearest first. */
export function preferredLanguage(tags: readonly string[]): Language {
  const wanted = tags.map((tag) => tag.split('-')[0]?.toLowerCase());
  return wanted.map((name) => LANGUAGES.find((language) => language === name)).find(Boolean) ?? 'en';
}

export let words: Words = english;

const spoken = createStore<Words>(() => english);
spoken.subscribe((next) => {
  words = next;
});

let wanted: Language = 'en';

/** Rejects where the words cannot be loaded; then those in use stay. Of several at once the last one is spoken. */
export async function speak(language: Language): Promise<void> {
  wanted = language;
  const next = await WORDS[language]();
  if (wanted === language) spoken.setState(next, true);
}

/** Draws its component again in each new language; its children follow. For the page, and whatever is drawn only as it changes. */
export const useWords = (): Words => useStore(spoken);
