// The menu of the timeline, at the pointer or below its button: the actions that fit what is selected, or what is done to a row.

import { memo } from 'react';
import { Menu, MenuItem, MenuSection, SubmenuTrigger } from 'react-aria-components/Menu';
import { Popover } from 'react-aria-components/Popover';
import { Separator } from 'react-aria-components/Separator';
import { useServoView, useStores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { chordText } from '../../../ui/Hint.tsx';
import { hinted } from '../../../ui/hinting.ts';
import { Icon } from '../../../ui/Icon.tsx';
import { words } from '../../../i18n/whole.ts';
import { contextOf, rowOf, type TimelineContext } from './context.ts';
import type { Row } from './rows.ts';
import {
  type ChoiceAction,
  COLOUR_ACTIONS,
  EASING_ACTIONS,
  ROW_ACTIONS,
  TIMELINE_ACTIONS,
  type TimelineActionName,
} from './timelineActions.ts';
import { InLanguage } from '../../../ui/InLanguage.tsx';
import styles from '../../../ui/Menu.module.css';

export interface OpenMenu {
  readonly kind: 'keys' | 'row';
  /** What it hangs on. */
  readonly anchor: { readonly current: Element | null };
}

const SECTIONS: readonly (readonly TimelineActionName[])[] = [
  ['setKey', 'editValue', 'block', 'marker', 'sound'],
  ['cut', 'copy', 'paste', 'duplicate', 'remove', 'removeTime'],
];
/** Behind a word of their own: all in one list are higher than a small window. */
const CHANGES: readonly TimelineActionName[] = [
  'reverse',
  'mirror',
  'scaleTime',
  'scaleTimeBack',
  'scaleAmplitude',
  'insertTime',
  'note',
];
const LOOKS: readonly TimelineActionName[] = [
  'selectAll',
  'selectRow',
  'fitSelection',
  'fitRows',
  'range',
  'nextMarker',
  'speed',
];

export const TimelineMenu = memo(function TimelineMenu({
  menu,
  onClose,
}: {
  readonly menu: OpenMenu | null;
  onClose(): void;
}) {
  return (
    <InLanguage>
      <Popover
        className={styles.popover ?? ''}
        triggerRef={menu?.anchor ?? { current: null }}
        isOpen={menu !== null}
        placement="bottom start"
        onOpenChange={(isOpen) => !isOpen && onClose()}
      >
        {menu?.kind === 'row' ? <RowMenu onClose={onClose} /> : <KeysMenu onClose={onClose} />}
      </Popover>
    </InLanguage>
  );
});

function KeysMenu({ onClose }: { onClose(): void }) {
  const stores = useStores();
  const context = contextOf(stores);
  const choiceItems = (actions: readonly ChoiceAction<unknown>[]): React.ReactElement[] =>
    actions.map(({ id, shortLabel, run }) => (
      <MenuItem key={id} className={styles.item ?? ''} onAction={() => run(contextOf(stores))}>
        {shortLabel()}
      </MenuItem>
    ));
  const items = (names: readonly TimelineActionName[]): React.ReactElement[] =>
    names.map((name) => <ActionItem key={name} action={TIMELINE_ACTIONS[name]} />);
  return (
    <Menu className={styles.menu ?? ''} aria-label={words.timeline.menu} autoFocus="first" onClose={onClose}>
      {SECTIONS.map((names) => (
        <MenuSection key={names[0]} aria-label={words.timeline.menu}>
          {items(names)}
          <Separator className={styles.separator ?? ''} />
        </MenuSection>
      ))}
      <Submenu label={words.timeline.change} isDisabled={false} onClose={onClose}>
        {items(CHANGES)}
      </Submenu>
      <Submenu label={words.timeline.easing} isDisabled={context.state.selected.size === 0} onClose={onClose}>
        {[...choiceItems(EASING_ACTIONS), ...items(['smooth', 'curve'])]}
      </Submenu>
      <Submenu label={words.timeline.colour} isDisabled={context.state.selected.size === 0} onClose={onClose}>
        {choiceItems(COLOUR_ACTIONS)}
      </Submenu>
      <Submenu label={words.timeline.rows.menu} isDisabled={false} onClose={onClose}>
        {rowItems(rowOf(context, context.state.cursor.row))}
      </Submenu>
      <Submenu label={words.timeline.look} isDisabled={false} onClose={onClose}>
        {items(LOOKS)}
      </Submenu>
    </Menu>
  );
}

function ActionItem({ action }: { readonly action: Action<TimelineContext> }) {
  const stores = useStores();
  const { icon, keys, label, enabled, run } = action;
  const context = contextOf(stores);
  const text = label(context);
  const mayNow = enabled(context);
  const [key] = keys;
  return (
    <MenuItem
      {...(mayNow !== true && hinted({ whyNot: mayNow }))}
      className={styles.item ?? ''}
      textValue={text}
      isDisabled={mayNow !== true}
      onAction={() => run(contextOf(stores))}
    >
      <Icon name={icon} />
      {text}
      {key !== undefined && <kbd className={styles.keys}>{chordText(key)}</kbd>}
    </MenuItem>
  );
}

/** Folding is for limbs alone, and a graph is of one servo. */
function rowItems(row: Row | undefined): React.ReactElement[] {
  const { folded, large, ...others } = ROW_ACTIONS;
  const actions = [
    ...(row?.kind === 'servo' ? [large] : []),
    ...Object.values(others),
    ...(row?.kind === 'limb' ? [folded] : []),
  ];
  return actions.map((action) => <ActionItem key={action.id} action={action} />);
}

function Submenu(props: {
  readonly label: string;
  readonly isDisabled: boolean;
  readonly children: readonly React.ReactElement[];
  /** Something was chosen: the menu it belongs to closes too. */
  onClose(): void;
}) {
  return (
    <SubmenuTrigger>
      <MenuItem className={styles.item ?? ''} textValue={props.label} isDisabled={props.isDisabled}>
        {props.label}
        <span className={styles.more}>
          <Icon name="later" />
        </span>
      </MenuItem>
      <Popover className={styles.popover ?? ''}>
        <Menu className={styles.menu ?? ''} aria-label={props.label} onClose={props.onClose}>
          {props.children}
        </Menu>
      </Popover>
    </SubmenuTrigger>
  );
}

function RowMenu({ onClose }: { onClose(): void }) {
  const stores = useStores();
  useServoView((servoView) => servoView);
  const context = contextOf(stores);
  return (
    <Menu
      className={styles.menu ?? ''}
      aria-label={words.timeline.rows.menu}
      autoFocus="first"
      onClose={onClose}
    >
      {rowItems(rowOf(context, context.state.cursor.row))}
    </Menu>
  );
}
