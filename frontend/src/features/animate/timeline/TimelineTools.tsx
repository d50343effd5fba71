// The toolbar of the timeline: its actions for hands without a keyboard, and the switches that say how edits behave.

import { memo, type ReactNode } from 'react';
import { useShallow } from 'zustand/react/shallow';
import { Toolbar } from 'react-aria-components/Toolbar';
import { sameEasing } from '#shared/group/curves.ts';
import { useStores, useView, useDocument, useTimeline } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { IconButton, ActionIconButton } from '../../../ui/Button.tsx';
import { Select } from '../../../ui/Select.tsx';
import { type KeySet, selectedKeys } from './timeline.ts';
import { useWords } from '../../../i18n/words.ts';
import { contextOf } from './context.ts';
import { type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';
import { EASING_CHOICES, type EasingName } from './valueText.ts';
import { EASING_ACTIONS, TIMELINE_ACTIONS, type TimelineActionName } from './timelineActions.ts';
import addsSwitchStyles from './AddsSwitch.module.css';
import { InLanguage } from '../../../ui/InLanguage.tsx';
import styles from './TimelineTools.module.css';
import { hinted } from '../../../ui/hinting.ts';
import { pressOnce } from '../../../ui/inputEvents.ts';

/** For touch, where there is no Ctrl key: a press in the timeline or the strip adds to the selection. Shown only on touch screens. */
export function AddsSwitch() {
  const { view } = useStores();
  const isOn = useView((state) => state.addsToSelection);
  return (
    <span className={addsSwitchStyles.adds}>
      <ToggleButton isOn={isOn} onChange={(addsToSelection) => view.setState({ addsToSelection })}>
        {words.actions.adds}
      </ToggleButton>
    </span>
  );
}

const ACTION_GROUPS: readonly (readonly TimelineActionName[])[] = [
  ['setKey', 'remove', 'copy', 'paste', 'duplicate'],
  ['keyBefore', 'keyAfter', 'zoomOut', 'zoomIn', 'fitAll'],
];
const SWITCHES = [
  ['snaps', 'snapsHint'],
  ['ripples', 'ripplesHint'],
  ['showsPreview', 'previewHint'],
  ['isTall', 'tallHint'],
] as const;

/** `openMenu`: the same function each time. */
export const TimelineTools = memo(function TimelineTools({
  openMenu,
}: {
  openMenu(kind: 'keys', button: Element): void;
}) {
  useWords();
  return (
    <InLanguage>
      <Toolbar className={styles.tools ?? ''} aria-label={words.timeline.toolbar}>
        {ACTION_GROUPS.map((names) => (
          <div key={names[0]} className={styles.group}>
            {names.map((name) => (
              <TimelineButton key={name} name={name} />
            ))}
          </div>
        ))}
        <IconButton icon="more" label={words.timeline.more} onPress={(button) => openMenu('keys', button)} />
        <AddsSwitch />
        <EasingChoice />
        <div className={styles.group}>
          {SWITCHES.map(([name, hint]) => (
            <Switch key={name} name={name} hint={words.timeline[hint]} />
          ))}
        </div>
      </Toolbar>
    </InLanguage>
  );
});

function Switch({ name, hint }: { readonly name: (typeof SWITCHES)[number][0]; readonly hint: string }) {
  const { timeline } = useStores();
  const isOn = useTimeline((state) => state[name]);
  return (
    <ToggleButton isOn={isOn} hint={hint} onChange={(wanted) => timeline.setState({ [name]: wanted })}>
      {words.timeline.switches[name]}
    </ToggleButton>
  );
}

function TimelineButton({ name }: { readonly name: TimelineActionName }) {
  const stores = useStores();
  const shown = useTimeline(useShallow(({ selected, marker, clip }) => ({ selected, marker, clip })));
  return (
    <ActionIconButton
      action={TIMELINE_ACTIONS[name]}
      shown={{ state: shown }}
      context={() => contextOf(stores)}
    />
  );
}

/** Of the selected keys; empty where they differ, or have a curve of their own. */
function EasingChoice() {
  const stores = useStores();
  const selected = useTimeline((state) => state.selected);
  const value = useDocument(({ present }) => commonEasing(timesOf(present), selected));
  return (
    <Select<EasingName | ''>
      label={words.timeline.easing}
      value={value}
      isDisabled={selected.size === 0}
      options={[
        ...(value === '' ? [{ value, label: words.timeline.easing } as const] : []),
        ...EASING_ACTIONS.map(({ choice, shortLabel }) => ({ value: choice, label: shortLabel() })),
      ]}
      onChange={(easing) => EASING_ACTIONS.find(({ choice }) => choice === easing)?.run(contextOf(stores))}
    />
  );
}

function commonEasing(times: GroupTimes, selected: KeySet): EasingName | '' {
  const keys = selectedKeys(times, selected);
  const common = EASING_CHOICES.find(({ easing }) => sameEasing(easing, keys[0]?.easing ?? 'linear'));
  const isOne = common !== undefined && keys.every((key) => sameEasing(key.easing, common.easing));
  return keys.length > 0 && isOne ? common.name : '';
}

interface ToggleButtonProps {
  readonly isOn: boolean;
  /** More than the label says. */
  readonly hint?: string;
  readonly children: ReactNode;
  onChange(isOn: boolean): void;
}

/** A button that stays pressed. */
function ToggleButton({ isOn, hint, children, onChange }: ToggleButtonProps) {
  return (
    <button
      {...hinted({ hint })}
      type="button"
      className={styles.toggle}
      aria-pressed={isOn}
      onClick={() => onChange(!isOn)}
      onKeyDown={pressOnce}
    >
      {children}
    </button>
  );
}
