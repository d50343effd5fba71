// Sets the page's language for components of react-aria. Used around each of them and not around the page, because the first load has
// none.

import type { ReactNode } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { useWords } from '../i18n/words.ts';

export function InLanguage({ children }: { readonly children: ReactNode }) {
  const { locale } = useWords();
  return <I18nProvider locale={locale}>{children}</I18nProvider>;
}
