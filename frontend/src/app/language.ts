// Has the chosen language spoken, from the start and at each choice; the browser's own where it is left to the system. Knows no
// panel.

import { preferredLanguage, speak, words } from '../i18n/words.ts';
import type { Notices } from '../state/notices.ts';
import type { View } from '../features/view.ts';

export interface LanguageOptions {
  readonly view: View;
  readonly notices: Notices;
  /** As `navigator.languages`. */
  readonly tags: readonly string[];
}

/** Resolves once the first one is spoken, so that nothing is named in another. */
export async function followLanguage({ view, notices, tags }: LanguageOptions): Promise<void> {
  async function follow(): Promise<void> {
    const { language } = view.getState();
    await speak(language === 'system' ? preferredLanguage(tags) : language).catch(() =>
      notices.tell('warning', words.language.notLoaded),
    );
  }
  view.subscribe((state, before) => {
    if (state.language !== before.language) void follow();
  });
  await follow();
}
