// The toolbar of the timeline: its verbs for hands without a keyboard, and the switches that say how edits behave.

import { Toolbar } from 'react-aria-components/Toolbar';
import { EASINGS, type Easing } from '#shared/actions/group/group.ts';
import { useStores } from '../stores/stores.ts';
import { IconButton } from '../ui/Button.tsx';
import { Hint } from '../ui/Hint.tsx';
import { Select } from '../ui/Select.tsx';
import { ToggleButton } from '../ui/ToggleButton.tsx';
import { words } from '../words/words.ts';
import { ease } from './changes.ts';
import { deskOf } from './desk.ts';
import { mayRun, VERBS, type VerbName } from './verbs.ts';
import type { SeenDesk } from './useDesk.ts';
import styles from './TimelineTools.module.css';

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

export function TimelineTools({
  desk,
  openMenu,
}: {
  readonly desk: SeenDesk;
  openMenu(button: Element): void;
}) {
  const { timeline } = useStores();
  return (
    <Toolbar className={styles.tools ?? ''} aria-label={words.timeline.toolbar}>
      {VERB_GROUPS.map((verbs) => (
        <div key={verbs[0]} className={styles.group}>
          {verbs.map((verb) => (
            <VerbButton key={verb} verb={verb} desk={desk} />
          ))}
        </div>
      ))}
      <IconButton icon="more" label={words.timeline.more} onPress={({ target }) => openMenu(target)} />
      <EasingChoice desk={desk} />
      <div className={styles.group}>
        {SWITCHES.map(([name, hint]) => (
          <Hint key={name} text={words.timeline[hint]}>
            <ToggleButton isOn={desk.state[name]} onChange={(isOn) => timeline.setState({ [name]: isOn })}>
              {words.timeline.switches[name]}
            </ToggleButton>
          </Hint>
        ))}
      </div>
    </Toolbar>
  );
}

function VerbButton({ verb, desk }: { readonly verb: VerbName; readonly desk: SeenDesk }) {
  const stores = useStores();
  return (
    <IconButton
      icon={VERBS[verb].icon}
      label={words.timeline.verbs[verb]}
      isDisabled={!mayRun(desk, VERBS[verb])}
      onPress={() => VERBS[verb].run(deskOf(stores))}
    />
  );
}

/** Of the frames with selected keys; empty where they differ. */
function EasingChoice({ desk: { times, state } }: { readonly desk: SeenDesk }) {
  const stores = useStores();
  const frames = new Set([...state.selected].map((name) => Number(name.split('/')[0])));
  const easings = new Set(times.frames.filter(({ id }) => frames.has(id)).map(({ easing }) => easing));
  const [only] = easings;
  const value: Easing | '' = easings.size === 1 && only !== undefined ? only : '';
  return (
    <Select<Easing | ''>
      label={words.timeline.easing}
      value={value}
      isDisabled={frames.size === 0}
      options={[
        ...(value === '' ? [{ value, label: words.timeline.easing } as const] : []),
        ...EASINGS.map((easing) => ({ value: easing, label: words.timeline.easings[easing] })),
      ]}
      onChange={(easing) => easing !== '' && ease(deskOf(stores), easing)}
    />
  );
}
