// The group's name as a text one edits in place; taken over on Enter or on leaving the field.

import { rename } from '#shared/actions/group/groupEdits.ts';
import { useGroup, useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import styles from './GroupName.module.css';

const MAX_LENGTH = 64;

export function GroupName() {
  const { document } = useStores();
  const { name } = useGroup();
  const take = (text: string): void => {
    const wanted = text.trim();
    if (wanted !== '')
      document.edit(
        () => words.actions.steps.rename,
        (group) => rename(group, wanted),
      );
  };
  return (
    <input
      key={name}
      className={styles.name}
      aria-label={words.actions.name}
      defaultValue={name}
      maxLength={MAX_LENGTH}
      autoComplete="off"
      spellCheck={false}
      onBlur={(event) => take(event.target.value)}
      onKeyDown={(event) => {
        if (event.key === 'Enter') event.currentTarget.blur();
      }}
    />
  );
}
