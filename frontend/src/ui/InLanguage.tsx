// What the library says by itself, in the language of the page. Around each part that the library makes, so that the first load, which
// has none of these, does without.

import type { ReactNode } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { useWords } from '../i18n/words.ts';

export function InLanguage({ children }: { readonly children: ReactNode }) {
  const { locale } = useWords();
  return <I18nProvider locale={locale}>{children}</I18nProvider>;
}
