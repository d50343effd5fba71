// Every action of the page with its keys, by the place in which they work: to be looked up, or searched and done. Made from the
// lists of actions alone.

import { useMemo } from 'react';
import { Autocomplete, useFilter } from 'react-aria-components/Autocomplete';
import { Header, Menu, MenuItem, MenuSection, Text } from 'react-aria-components/Menu';
import { Input, SearchField } from 'react-aria-components/SearchField';
import { useStores } from '../features/stores.ts';
import { chordText } from '../ui/chordText.ts';
import { cx } from '../ui/cx.ts';
import { Icon } from '../ui/Icon.tsx';
import { words } from '../i18n/whole.ts';
import { ACTION_PLACES, type ActionPlace, type ListedAction } from './actionPlaces.ts';
import field from '../ui/Field.module.css';
import styles from './ActionList.module.css';

/** `onChoose` is given what is to be done once the list is closed. */
export function ActionList({ onChoose }: { onChoose(run: () => void): void }) {
  const { contains } = useFilter({ sensitivity: 'base' });
  const stores = useStores();
  const places = useMemo(
    () => ACTION_PLACES.map((place) => ({ place, actions: place.actions(stores) })),
    [stores],
  );
  return (
    <div className={styles.all}>
      <Autocomplete filter={contains}>
        <SearchField aria-label={words.actionList.search} autoFocus>
          <Input className={cx(field.field, styles.search)} placeholder={words.actionList.search} />
        </SearchField>
        <Menu
          className={styles.list ?? ''}
          aria-label={words.actionList.title}
          renderEmptyState={() => <p className={styles.empty}>{words.actionList.nothing}</p>}
        >
          {places.map(({ place, actions }) => (
            <Place key={place.id} place={place} actions={actions} onChoose={onChoose} />
          ))}
        </Menu>
      </Autocomplete>
    </div>
  );
}

interface PlaceProps {
  readonly place: ActionPlace;
  readonly actions: readonly ListedAction[];
  onChoose(run: () => void): void;
}

function Place({ place, actions, onChoose }: PlaceProps) {
  const name = words.actionList.places[place.id];
  return (
    <MenuSection aria-label={name}>
      <Header className={styles.place}>{name}</Header>
      {actions.map(({ id, icon, keys, label, enabled, run }) => (
        <MenuItem
          key={id}
          id={`${place.id} ${id}`}
          className={styles.item ?? ''}
          textValue={label}
          isDisabled={enabled !== true}
          onAction={() => onChoose(run)}
        >
          <Icon name={icon} />
          <Text slot="label">{label}</Text>
          {enabled !== true && (
            <Text slot="description" className={styles.whyNot ?? ''}>
              {enabled}
            </Text>
          )}
          <Keys keys={keys} />
        </MenuItem>
      ))}
      {place.keys.map(({ id, keys, label }) => (
        <MenuItem
          key={id}
          id={`${place.id} ${id}`}
          className={cx(styles.item, styles.keysAlone)}
          textValue={label()}
          isDisabled
        >
          <Text slot="label">{label()}</Text>
          <Keys keys={keys} />
        </MenuItem>
      ))}
    </MenuSection>
  );
}

function Keys({ keys }: { readonly keys: readonly string[] }) {
  return (
    <span className={styles.keys}>
      {keys.map((chord) => (
        <kbd key={chord} className={styles.key}>
          {chordText(chord)}
        </kbd>
      ))}
    </span>
  );
}
