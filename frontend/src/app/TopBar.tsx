// The slim bar: which robot, how it is linked, its activity, the battery. The right end is reserved for STOP.

import { useStore } from 'zustand';
import { useStores, useView, useDevice } from '../features/stores.ts';
import type { LanguageChoice, Theme } from '../features/view.ts';
import { Icon, type IconName } from '../ui/Icon.tsx';
import { LANGUAGE_CODES, LANGUAGES, words } from '../i18n/words.ts';
import { nameOf } from '../robot/device.ts';
import { RobotButton } from '../features/profiles/RobotDialog.tsx';
import { BatteryReadout } from '../features/battery/BatteryReadout.tsx';
import { IconButton } from '../ui/Button.tsx';
import { titleFor } from '../features/people/people.ts';
import { boardName } from '../i18n/sentences.ts';
import { LinkChip, StatusLine, type StatusLineProps } from '../features/connect/StatusLine.tsx';
import { ActionsButton } from './dialogs.tsx';
import { THEME } from './pageActions.ts';
import { PART } from '../ui/focus.ts';
import styles from './TopBar.module.css';
import { useLayout } from '../ui/useLayout.ts';
import { WorkspaceSwitch } from './workspaces/parts.tsx';

// Which language the page speaks. Each is called by its own name, for people who cannot read the others.

function LanguageControl() {
  const { view } = useStores();
  const language = useView((state) => state.language);
  return (
    <div className={styles.control} title={words.language.label}>
      <Icon name="globe" />
      <select
        className={styles.select}
        aria-label={words.language.label}
        value={language}
        onChange={(event) => view.setState({ language: event.target.value as LanguageChoice })}
      >
        <option value="system">{words.language.system}</option>
        {LANGUAGE_CODES.map((one) => (
          <option key={one} value={one} lang={one}>
            {LANGUAGES[one].name}
          </option>
        ))}
      </select>
    </div>
  );
}

export function TopBar({ onMoveHere }: Pick<StatusLineProps, 'onMoveHere'>) {
  const isShared = useDevice(({ snapshot }) => snapshot.canShare);
  const layout = useLayout();
  return (
    <header {...PART} className={styles.bar} data-shared={isShared} aria-label={words.regions.top}>
      <h1 className={styles.product}>
        <Sign />
        <span className={styles.productName}>{words.product}</span>
      </h1>
      <Robot />
      <StatusLine className={styles.status} onMoveHere={onMoveHere} />
      {layout === 'desktop' && (
        <div className={styles.pages}>
          <WorkspaceSwitch />
        </div>
      )}
      <BatteryReadout />
      <div className={styles.looks}>
        <span className={styles.actions}>
          <ActionsButton />
        </span>
        <FleetLink />
        <PeopleButton />
        <LanguageControl />
        <ThemeButton />
      </div>
    </header>
  );
}

/** The product's sign: a servo horn on its scale. */
function Sign() {
  return (
    <svg className={styles.sign} viewBox="0 0 32 32" aria-hidden="true" focusable="false">
      <path className={styles.signScale} d="M6.5 23.5A12 12 0 1 1 25.5 23.5" />
      <path
        className={styles.signHorn}
        d="M13.2 17.6L21.6 6.6a1.6 1.6 0 0 1 2.8 1.6l-5.6 12.6a3.4 3.4 0 1 1-5.6-3.2z"
      />
    </svg>
  );
}

function Robot() {
  const { boards } = useStores();
  const way = useDevice((state) => state.way);
  const family = useDevice((state) => state.family);
  const nickname = useStore(boards.store, (all) => (way === null ? '' : all[nameOf(way)]?.nickname)) ?? '';
  const name = way === null ? words.link.noBoard : way.isSimulated ? '' : nickname || boardName(family);
  return (
    <div className={styles.robot}>
      <RobotButton />
      {name !== '' && <span className={styles.robotName}>{name}</span>}
      <LinkChip />
    </div>
  );
}

const THEME_ICONS: Readonly<Record<Theme, IconName>> = { system: 'half', light: 'sun', dark: 'moon' };

function ThemeButton() {
  const stores = useStores();
  const icon = THEME_ICONS[useView((state) => state.theme)];
  return <IconButton icon={icon} label={THEME.label(stores)} onPress={() => THEME.run(stores)} />;
}

/** Where this gateway serves a fleet. */
function FleetLink() {
  const { people } = useStores();
  const me = useStore(people.store, (state) => state.me);
  if (me?.pages.includes('fleet') !== true) return null;
  const label = words.regions.fleet;
  return (
    <a className={styles.control} href="./fleet.html" aria-label={label} title={label}>
      <Icon name="fleet" />
    </a>
  );
}

function PeopleButton() {
  const { people, view } = useStores();
  const me = useStore(people.store, (state) => state.me);
  if (me === null || me.mode === 'local') return null;
  return (
    <IconButton
      icon="people"
      label={titleFor(me)}
      aria-haspopup="dialog"
      onPress={() => view.setState({ peopleOpen: true })}
    />
  );
}
