// Which language the page speaks. Each is called by its own name, for whoever cannot read the others.

import { useStores, useView } from '../features/stores.ts';
import type { LanguageChoice } from '../features/view.ts';
import { Icon } from '../ui/Icon.tsx';
import { LANGUAGE_CODES, LANGUAGES, words } from '../i18n/words.ts';
import styles from './LanguageControl.module.css';

export function LanguageControl() {
  const { view } = useStores();
  const language = useView((state) => state.language);
  return (
    <div className={styles.control} title={words.language.label}>
      <Icon name="globe" />
      <select
        className={styles.select}
        aria-label={words.language.label}
        value={language}
        onChange={(event) => view.setState({ language: event.target.value as LanguageChoice })}
      >
        <option value="system">{words.language.system}</option>
        {LANGUAGE_CODES.map((one) => (
          <option key={one} value={one} lang={one}>
            {LANGUAGES[one].name}
          </option>
        ))}
      </select>
    </div>
  );
}
