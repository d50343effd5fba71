// What can be done with one group of the library: name, tags, a copy, its versions, the trash.

import type { Listed } from '#shared/files/keeper.ts';
import { rename } from '#shared/group/groupEdits.ts';
import { tagsFromText, tagsToText } from '#shared/files/libraryText.ts';
import { useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { NameField } from '../../ui/NameField.tsx';
import { words } from '../../i18n/whole.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './Library.module.css';
import { Versions } from './Versions.tsx';

export interface DocumentDetailsProps {
  readonly document: Listed;
  onDone(): void;
}

export function DocumentDetails({ document, onDone }: DocumentDetailsProps) {
  const { library } = useStores();
  const { id, facts } = document;
  const { name } = facts;
  return (
    <div className={styles.details}>
      <NameField
        isFramed
        label={words.library.name({ name })}
        name={name}
        onRename={(wanted) =>
          void library.change(
            id,
            () => words.library.steps.rename,
            (group) => rename(group, wanted),
          )
        }
      />
      <TagsField
        label={words.library.tags({ name })}
        tags={facts.tags}
        onChange={(tags) =>
          void library.change(
            id,
            () => words.library.steps.tags,
            (group) => ({ ...group, tags }),
          )
        }
      />
      <div className={styles.verbs}>
        <Button icon="copy" onPress={() => void library.duplicate(id)}>
          {words.library.duplicate}
        </Button>
        <Button icon="trash" onPress={() => void library.remove(id)}>
          {words.library.remove}
        </Button>
      </div>
      <Versions id={id} onDone={onDone} />
    </div>
  );
}

interface TagsFieldProps {
  readonly label: string;
  readonly tags: readonly string[];
  onChange(tags: readonly string[]): void;
}

function TagsField({ label, tags, onChange }: TagsFieldProps) {
  const text = tagsToText(tags);
  return (
    <label className={styles.tags}>
      <span>{words.library.tagsLabel}</span>
      <input
        key={text}
        className={cx(field.field, styles.field)}
        aria-label={label}
        placeholder={words.library.tagsHint}
        autoComplete="off"
        defaultValue={text}
        onBlur={({ target }) => {
          const wanted = tagsFromText(target.value);
          if (tagsToText(wanted) !== text) onChange(wanted);
        }}
        onKeyDown={(event) => {
          if (event.key === 'Enter') event.currentTarget.blur();
        }}
      />
    </label>
  );
}
