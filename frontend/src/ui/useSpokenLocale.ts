// The locale of the words in use, for whoever puts the page together: the document says its language, and all below is drawn again
// in a new one.

import { useEffect } from 'react';
import { useWords } from '../i18n/words.ts';

export function useSpokenLocale(): string {
  const { locale } = useWords();
  useEffect(() => {
    document.documentElement.lang = locale;
  }, [locale]);
  return locale;
}
