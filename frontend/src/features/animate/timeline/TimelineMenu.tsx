// The menu of the timeline, at the pointer or below its button: the actions that fit what is selected, or what is done to a row.

import { memo } from 'react';
import { Menu, MenuItem, MenuSection, SubmenuTrigger } from 'react-aria-components/Menu';
import { Popover } from 'react-aria-components/Popover';
import { Separator } from 'react-aria-components/Separator';
import { COLOURS } from '#shared/document/schema.ts';
import { EASINGS } from '#shared/group/group.ts';
import { toggled, type ServoView } from '../../servoView.ts';
import { editServoView, useServoView, useStores } from '../../stores.ts';
import { chordText } from '../../../ui/action.ts';
import { hinted } from '../../../ui/hinting.ts';
import { Icon } from '../../../ui/Icon.tsx';
import { words } from '../../../i18n/whole.ts';
import { colour, ease } from './changes.ts';
import { contextOf, rowOf } from './context.ts';
import type { Row } from './rows.ts';
import { TIMELINE_ACTIONS, type TimelineActionName } from './timelineActions.ts';
import { InLanguage } from '../../../ui/InLanguage.tsx';
import styles from '../../../ui/Menu.module.css';

export interface OpenMenu {
  readonly kind: 'keys' | 'row';
  /** What it hangs on. */
  readonly anchor: { readonly current: Element | null };
}

const SECTIONS: readonly (readonly TimelineActionName[])[] = [
  ['setKey', 'editValue', 'marker'],
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
  'range',
  'nextMarker',
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
  const items = (names: readonly TimelineActionName[]): React.ReactElement[] =>
    names.map((name) => <ActionItem key={name} name={name} />);
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
        {EASINGS.map((easing) => (
          <MenuItem
            key={easing}
            className={styles.item ?? ''}
            onAction={() => ease(contextOf(stores), easing)}
          >
            {words.timeline.easings[easing]}
          </MenuItem>
        ))}
      </Submenu>
      <Submenu label={words.timeline.colour} isDisabled={context.state.selected.size === 0} onClose={onClose}>
        {[...COLOURS, null].map((one) => (
          <MenuItem
            key={one ?? ''}
            className={styles.item ?? ''}
            onAction={() => colour(contextOf(stores), one)}
          >
            {one === null ? words.timeline.noColour : words.timeline.colours[one]}
          </MenuItem>
        ))}
      </Submenu>
      <Submenu label={words.timeline.rows.menu} isDisabled={false} onClose={onClose}>
        {rowItems(context.servoView, rowOf(context, context.state.cursor.row), (change) =>
          editServoView(stores, change),
        )}
      </Submenu>
      <Submenu label={words.timeline.look} isDisabled={false} onClose={onClose}>
        {items(LOOKS)}
      </Submenu>
    </Menu>
  );
}

function ActionItem({ name }: { readonly name: TimelineActionName }) {
  const stores = useStores();
  const { icon, keys, label, enabled, run } = TIMELINE_ACTIONS[name];
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
  const view = useServoView((servoView) => servoView);
  const context = contextOf(stores);
  return (
    <Menu
      className={styles.menu ?? ''}
      aria-label={words.timeline.rows.menu}
      autoFocus="first"
      onClose={onClose}
    >
      {rowItems(view, rowOf(context, context.state.cursor.row), (change) => editServoView(stores, change))}
    </Menu>
  );
}

type ChangeView = (change: (view: ServoView) => ServoView) => void;

function rowItems(view: ServoView, row: Row | undefined, change: ChangeView): React.ReactElement[] {
  const { rows } = words.timeline;
  const servos = row?.servos ?? [];
  const isAll = (list: readonly number[]): boolean =>
    servos.length > 0 && servos.every((servo) => list.includes(servo));
  const items = [
    { list: 'locked', icon: 'lock', label: isAll(view.locked) ? rows.unlock : rows.lock },
    { list: 'muted', icon: 'mute', label: isAll(view.muted) ? rows.unmute : rows.mute },
    { list: 'solo', icon: 'solo', label: isAll(view.solo) ? rows.unsolo : rows.solo },
    { list: 'armed', icon: 'record', label: isAll(view.armed) ? rows.disarm : rows.arm },
    { list: 'hidden', icon: 'hide', label: rows.hide },
  ] as const;
  const own = items.map(({ list, icon, label }) => (
    <MenuItem
      key={list}
      className={styles.item ?? ''}
      textValue={label}
      onAction={() => change((before) => ({ ...before, [list]: toggled(before[list], servos) }))}
    >
      <Icon name={icon} />
      {label}
    </MenuItem>
  ));
  return row?.kind === 'limb' ? [...own, foldItem(view, row.name, change)] : own;
}

function foldItem(view: ServoView, limb: string, change: ChangeView): React.ReactElement {
  const isFolded = view.folded.includes(limb);
  const label = isFolded ? words.timeline.rows.unfold : words.timeline.rows.foldAway;
  return (
    <MenuItem
      key="folded"
      className={styles.item ?? ''}
      textValue={label}
      onAction={() => change((before) => ({ ...before, folded: toggled(before.folded, [limb]) }))}
    >
      <Icon name={isFolded ? 'later' : 'down'} />
      {label}
    </MenuItem>
  );
}
