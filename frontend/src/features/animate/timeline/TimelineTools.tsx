// The toolbar of the timeline: its verbs for hands without a keyboard, and the switches that say how edits behave.

import { memo } from 'react';
import { Toolbar } from 'react-aria-components/Toolbar';
import { EASINGS, type Easing } from '#shared/group/group.ts';
import { useStores, useView, useDocument, useTimeline } from '../../stores.ts';
import { ToggleButton } from '../../../ui/Toggle.tsx';
import { words } from '../../../i18n/whole.ts';
import { IconButton } from '../../../ui/Button.tsx';
import { Select } from '../../../ui/Select.tsx';
import type { KeySet } from './timeline.ts';
import { useWords } from '../../../i18n/words.ts';
import { ease } from './changes.ts';
import { contextOf } from './context.ts';
import { selectedKeys, timesOf, type GroupTimes } from './groupTimes.ts';
import { mayRun, verbName, VERBS, type VerbName } from './verbs.ts';
import addsSwitchStyles from './AddsSwitch.module.css';
import { InLanguage } from '../../../ui/InLanguage.tsx';
import styles from './TimelineTools.module.css';

// For hands without a Ctrl key: what is pressed in the timeline or the strip goes beside what is selected. Stands
// with the tools of both; seen only where fingers are.

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

const VERB_GROUPS: readonly (readonly VerbName[])[] = [
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
        {VERB_GROUPS.map((verbs) => (
          <div key={verbs[0]} className={styles.group}>
            {verbs.map((verb) => (
              <VerbButton key={verb} verb={verb} />
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

function VerbButton({ verb }: { readonly verb: VerbName }) {
  const stores = useStores();
  const mayNow = useTimeline((state) => mayRun({ state }, VERBS[verb]));
  const label = useTimeline((state) => verbName(verb, state));
  return (
    <IconButton
      icon={VERBS[verb].icon}
      label={label}
      isDisabled={!mayNow}
      onPress={() => VERBS[verb].run(contextOf(stores))}
    />
  );
}

/** Of the frames with selected keys; empty where they differ. */
function EasingChoice() {
  const stores = useStores();
  const selected = useTimeline((state) => state.selected);
  const value = useDocument(({ present }) => commonEasing(timesOf(present), selected));
  return (
    <Select<Easing | ''>
      label={words.timeline.easing}
      value={value}
      isDisabled={selected.size === 0}
      options={[
        ...(value === '' ? [{ value, label: words.timeline.easing } as const] : []),
        ...EASINGS.map((easing) => ({ value: easing, label: words.timeline.easings[easing] })),
      ]}
      onChange={(easing) => easing !== '' && ease(contextOf(stores), easing)}
    />
  );
}

function commonEasing(times: GroupTimes, selected: KeySet): Easing | '' {
  const keys = selectedKeys(times, selected);
  const easing = keys[0]?.easing ?? '';
  return keys.every((key) => key.easing === easing) ? easing : '';
}
