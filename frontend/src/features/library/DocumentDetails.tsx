// What can be done with one group of the library: name, tags, a copy, its versions, the trash.

import { useEffect, useState, type SubmitEvent } from 'react';
import type { Version, Listed } from '#shared/files/documentStore.ts';
import { rename } from '#shared/group/groupEdits.ts';
import { tagsFromText, tagsToText } from '#shared/files/libraryText.ts';
import { useLibrary, useStores } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { NameField } from '../../ui/NameField.tsx';
import { words } from '../../i18n/whole.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './Library.module.css';

// Named versions of a group: keeping one as it is now, renaming one, going back to one, deleting one.

const MAX_NAME_LENGTH = 64;

function Versions({ id, onDone }: { readonly id: string; onDone(): void }) {
  const { library } = useStores();
  const listings = useLibrary((state) => state.listings);
  const [versions, setVersions] = useState<readonly Version[]>([]);
  const [name, setName] = useState('');

  useEffect(() => {
    let isGone = false;
    void library.versions(id).then((found) => {
      if (!isGone) setVersions(found);
    });
    return () => {
      isGone = true;
    };
    // Whoever changed one has had the library listed again.
  }, [library, id, listings]);

  async function keep(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const wanted = name.trim();
    if (wanted === '') return;
    setName('');
    await library.keepVersion(id, wanted);
  }

  return (
    <section className={styles.versions} aria-label={words.library.versions}>
      <form className={styles.keep} onSubmit={(event) => void keep(event)}>
        <input
          className={cx(field.field, styles.field)}
          aria-label={words.library.versionName}
          placeholder={words.library.versionHint}
          maxLength={MAX_NAME_LENGTH}
          autoComplete="off"
          value={name}
          onChange={({ target }) => setName(target.value)}
        />
        <Button type="submit" isDisabled={name.trim() === ''}>
          {words.library.keepVersion}
        </Button>
      </form>
      {versions.length === 0 ? (
        <p className={styles.hint}>{words.library.noVersions}</p>
      ) : (
        <ul>
          {versions.toReversed().map((version) => (
            <li key={version.id} className={styles.version}>
              <NameField
                label={words.library.nameOfVersion({ name: version.name })}
                name={version.name}
                onRename={(wanted) => void library.renameVersion(id, version, wanted)}
              />
              <span className={styles.about}>{words.dates.formatMoment(version.atMs)}</span>
              <Button
                aria-label={words.library.restoreVersion({ name: version.name })}
                onPress={() => void library.restoreVersion(id, version).then(onDone)}
              >
                {words.library.goBack}
              </Button>
              <IconButton
                icon="trash"
                label={words.library.removeVersion({ name: version.name })}
                onPress={() => void library.removeVersion(id, version)}
              />
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}

interface DocumentDetailsProps {
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
