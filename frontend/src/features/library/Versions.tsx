// Named versions of a group: keeping one as it is now, renaming one, going back to one, deleting one.

import { useEffect, useState, type SubmitEvent } from 'react';
import type { Version } from '#shared/files/keeper.ts';
import { useLibrary, useStores } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { NameField } from '../../ui/NameField.tsx';
import { words } from '../../i18n/whole.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './Library.module.css';

const MAX_NAME_LENGTH = 64;

export function Versions({ id, onDone }: { readonly id: string; onDone(): void }) {
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
