// What is looked for in the library: words, a tag, an order, the trash.

import { Select } from '../../ui/Select.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import { SORTS, type Wish } from './arrange.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './Library.module.css';

export interface LibraryFinderProps {
  readonly wish: Wish;
  readonly tags: readonly string[];
  onWish(wish: Wish): void;
}

export function LibraryFinder({ wish, tags, onWish }: LibraryFinderProps) {
  // A tag whose last group has gone leads nowhere.
  const offered = tags.includes(wish.tag) || wish.tag === '' ? tags : [wish.tag, ...tags];
  return (
    <div className={styles.finder} role="search">
      <input
        type="search"
        className={cx(field.field, styles.field)}
        aria-label={words.library.search}
        placeholder={words.library.searchHint}
        autoComplete="off"
        value={wish.search}
        onChange={({ target }) => onWish({ ...wish, search: target.value })}
      />
      {offered.length > 0 && (
        <Select
          label={words.library.tag}
          value={wish.tag}
          options={[
            { value: '', label: words.library.everyTag },
            ...offered.map((tag) => ({ value: tag, label: tag })),
          ]}
          onChange={(tag) => onWish({ ...wish, tag })}
        />
      )}
      <Select
        label={words.library.sort}
        value={wish.sort}
        options={SORTS.map((sort) => ({ value: sort, label: words.library.sorts[sort] }))}
        onChange={(sort) => onWish({ ...wish, sort })}
      />
      <Toggle
        label={words.library.showRemoved}
        isOn={wish.isRemoved}
        onChange={(isRemoved) => onWish({ ...wish, isRemoved })}
      />
    </div>
  );
}
