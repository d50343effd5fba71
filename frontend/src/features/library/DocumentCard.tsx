// One group of the library as a card: the picture opens it; details with name, tags, copy, versions and trash unfold in place.

import styles from './Library.module.css';
import field from '../../ui/Field.module.css';
import { useStore } from 'zustand';
import { memo, type Ref, useEffect, useState, type SubmitEvent } from 'react';
import type { GroupFacts } from '#shared/files/facts.ts';
import { familyOfUnit } from '#shared/profile/units.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { Listed, Version } from '#shared/files/documentStore.ts';
import { BarThumb, RobotThumb } from '../picture/PoseThumb.tsx';
import { useStores, useLibrary } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import { rename } from '#shared/group/groupEdits.ts';
import { tagsFromText, tagsToText } from '#shared/files/libraryText.ts';
import { NameField } from '../../ui/NameField.tsx';

/** The robot in the pose of the middle frame, or bars if the robot is unknown here. */
function DocumentThumb({ facts }: { readonly facts: GroupFacts }) {
  const { robots } = useStores();
  const robot = useStore(
    robots.store,
    ({ present }) => present.own.find((one) => one.robot.name === facts.robot)?.robot,
  );
  const pose = new Map(facts.pose.map(({ servo, position }) => [servo, position]));
  const isFitting = robot !== undefined && FAMILIES[robot.board].unit === facts.unit;
  const rest = { pose, changed: [...pose.keys()], family: familyOfUnit(facts.unit) };
  return isFitting ? (
    <RobotThumb {...rest} robot={robot} family={FAMILIES[robot.board]} />
  ) : (
    <BarThumb {...rest} />
  );
}

const DRAFT = 'draft';
const AUTHOR = 'by ';

/** The tags as people read them: of a proposal that nobody has taken yet, whose it is. */
function tagWords(tags: readonly string[]): readonly string[] {
  if (!tags.includes(DRAFT)) return tags;
  const author = tags.find((tag) => tag.startsWith(AUTHOR));
  const draft =
    author === undefined ? words.library.draft : words.library.draftBy({ name: author.slice(AUTHOR.length) });
  return [draft, ...tags.filter((tag) => tag !== DRAFT && tag !== author)];
}

interface DocumentCardProps {
  /** Set on the card whose height is measured for its row. */
  readonly ref?: Ref<HTMLLIElement>;
  readonly row: number;
  /** Position in the whole list of `count` cards, from 1: not all of them are rendered. */
  readonly place: number;
  readonly count: number;
  readonly document: Listed;
  readonly nowMs: number;
  readonly isUnfolded: boolean;
  onUnfold(id: string, isUnfolded: boolean): void;
  onDone(): void;
}

/** Memoised, because the list is refreshed every few seconds. */
export const DocumentCard = memo(function DocumentCard({
  ref,
  row,
  place,
  count,
  document,
  nowMs,
  isUnfolded,
  onUnfold,
  onDone,
}: DocumentCardProps) {
  const { library } = useStores();
  const { id, facts, isRemoved } = document;
  const isOpen = useLibrary((state) => state.openId === id);
  const { name, frames, durationMs, robot, tags } = facts;
  const open = (): void => void library.open(id).then(onDone);
  return (
    <li
      ref={ref}
      data-index={row}
      data-document={id}
      aria-posinset={place}
      aria-setsize={count}
      className={cx(styles.card, isUnfolded && styles.unfolded, isOpen && styles.current)}
    >
      <div className={styles.front}>
        <button
          type="button"
          data-card-face=""
          className={styles.face}
          aria-label={words.library.open({ name })}
          aria-current={isOpen}
          disabled={isRemoved}
          onClick={open}
        >
          <DocumentThumb facts={facts} />
        </button>
        <div className={styles.foot}>
          <span className={styles.name}>{name}</span>
          {isRemoved ? (
            <Button onPress={() => void library.restore(id)}>{words.library.restore}</Button>
          ) : (
            <IconButton
              icon="more"
              label={words.library.more({ name })}
              aria-expanded={isUnfolded}
              onPress={() => onUnfold(id, !isUnfolded)}
            />
          )}
          <span className={styles.about}>
            {isOpen ? words.library.isOpen : words.dates.formatLongAge(nowMs - facts.updatedAtMs)}
          </span>
          <span className={styles.about}>{words.library.about({ count: frames, durationMs })}</span>
          <span className={styles.about}>
            {[robot, ...tagWords(tags)].filter((word) => word !== '').join(' · ')}
          </span>
        </div>
      </div>
      {isUnfolded && !isRemoved && <DocumentDetails document={document} onDone={onDone} />}
    </li>
  );
});

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
    // Each change of a version lists the library again.
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

function DocumentDetails({ document, onDone }: DocumentDetailsProps) {
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
