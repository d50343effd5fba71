// Every action of the page with its keys, by the place in which the keys work: as a list to search and run from, and for the tests that
// hold for each action. Made from the lists of actions alone.

import { useMemo } from 'react';
import { Autocomplete, useFilter } from 'react-aria-components/Autocomplete';
import { Header, Menu, MenuItem, MenuSection, Text } from 'react-aria-components/Menu';
import { Input, SearchField } from 'react-aria-components/SearchField';
import { useStores, type Stores } from '../features/stores.ts';
import { chordText } from '../ui/Hint.tsx';
import { cx } from '../ui/cx.ts';
import { Icon } from '../ui/Icon.tsx';
import { words, type Words } from '../i18n/whole.ts';
import field from '../ui/Field.module.css';
import styles from './ActionList.module.css';
import { FRAME_ACTIONS, FRAME_KEYS, frameContextOf } from '../features/animate/frames/frameActions.ts';
import { PLAY_ACTIONS } from '../features/animate/play/playActions.ts';
import { RECORD_OVER } from '../features/animate/play/recordOver.ts';
import { contextOf } from '../features/animate/timeline/context.ts';
import {
  COLOUR_ACTIONS,
  EASING_ACTIONS,
  MENU_KEYS,
  ROW_ACTIONS,
  TIMELINE_ACTIONS,
  TIMELINE_KEYS,
} from '../features/animate/timeline/timelineActions.ts';
import { MACRO_ACTIONS, macroContextOf } from '../features/buttons/macroActions.ts';
import { POSE_ACTIONS, poseContextOf } from '../features/poses/poseActions.ts';
import { workedOn } from '../features/view.ts';
import type { Action, KeyUse } from '../ui/action.ts';
import { walkKeys } from '../ui/cards.ts';
import { PAGE_ACTIONS } from './pageActions.ts';

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
      <a className={styles.licences} href="./third-party-licences.txt" target="_blank" rel="noreferrer">
        {words.actionList.licences}
      </a>
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

/** An action as it is now, in the words of the moment. */
interface ListedAction extends Pick<Action<never>, 'id' | 'icon' | 'keys'> {
  readonly label: string;
  readonly enabled: true | string;
  run(): void;
}

type ListedKeys = Pick<KeyUse<never>, 'id' | 'keys' | 'label'>;

interface ActionPlace {
  readonly id: keyof Words['actionList']['places'];
  actions(stores: Stores): readonly ListedAction[];
  readonly keys: readonly ListedKeys[];
}

/** `where`: `true` where the place is on the page now, else how it is opened. */
function listed<Context extends Shown, Shown>(
  actions: readonly Action<Context, Shown>[],
  context: () => Context,
  where: true | string = true,
): readonly ListedAction[] {
  const now = context();
  return actions.map(({ id, icon, keys, label, enabled, run }) => ({
    ...{ id, icon, keys },
    label: label(now),
    enabled: where === true ? enabled(now) : where,
    run: () => run(context()),
  }));
}

function isOpen({ view }: Stores, authoring: 'group' | 'poses'): true | string {
  return (
    workedOn(view.getState()) === authoring ||
    words.actionList.elsewhere({ place: words.authoring[authoring] })
  );
}

const areEdited = ({ view }: Stores): true | string => {
  const { tab, editsButtons } = view.getState();
  return (
    (tab === 'buttons' && editsButtons) ||
    words.actionList.elsewhere({ place: words.actionList.places.buttons })
  );
};

export const ACTION_PLACES: readonly ActionPlace[] = [
  { id: 'page', keys: [], actions: (stores) => listed(PAGE_ACTIONS, () => stores) },
  {
    ...{ id: 'timeline', keys: [...TIMELINE_KEYS, MENU_KEYS] },
    actions: (stores) => [
      ...listed([...PLAY_ACTIONS, RECORD_OVER], () => stores, isOpen(stores, 'group')),
      ...listed(
        [...Object.values(TIMELINE_ACTIONS), ...EASING_ACTIONS, ...COLOUR_ACTIONS],
        () => contextOf(stores),
        isOpen(stores, 'group'),
      ),
    ],
  },
  {
    ...{ id: 'row', keys: [] },
    actions: (stores) => listed(Object.values(ROW_ACTIONS), () => contextOf(stores), isOpen(stores, 'group')),
  },
  {
    ...{ id: 'frames', keys: FRAME_KEYS },
    actions: (stores) =>
      listed(Object.values(FRAME_ACTIONS), () => frameContextOf(stores), isOpen(stores, 'group')),
  },
  {
    ...{ id: 'poses', keys: [walkKeys()] },
    actions: (stores) =>
      listed(Object.values(POSE_ACTIONS), () => poseContextOf(stores), isOpen(stores, 'poses')),
  },
  {
    ...{ id: 'buttons', keys: [walkKeys()] },
    actions: (stores) =>
      listed(Object.values(MACRO_ACTIONS), () => macroContextOf(stores), areEdited(stores)),
  },
];
