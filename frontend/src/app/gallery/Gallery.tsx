// Every panel in every state, one below the other, with a list of links on top; `?state=` in the address shows one alone. The panels are
// the real ones; the robot behind them is frozen.

import { useState, useSyncExternalStore, type MouseEvent } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { FAMILIES } from '#shared/codec/families.ts';
import { FilesProvider } from '../../features/library/files/FilesArea.tsx';
import { StoresContext } from '../../features/stores.ts';
import { useSpokenLocale } from '../../i18n/words.ts';
import { CONNECT, PEOPLE } from './PeopleSpecimens.tsx';
import { DASHBOARDS } from './DashboardSpecimens.tsx';
import { type Exhibit, specimenStores } from './exhibit.ts';
import { FLEET } from './FleetSpecimens.tsx';
import { FILES, LIBRARY } from './LibrarySpecimens.tsx';
import { MESSAGES, RAW } from './MessageSpecimens.tsx';
import { PADS, POSES } from './PoseSpecimens.tsx';
import { PLAYING } from './PlaySpecimens.tsx';
import { ROBOTS } from './RobotSpecimens.tsx';
import { TIMELINES } from './TimelineSpecimens.tsx';
import styles from './Gallery.module.css';

const EXHIBITS: readonly Exhibit[] = [
  ...[...DASHBOARDS, ...CONNECT, ...MESSAGES, ...RAW, ...PADS, ...POSES, ...PLAYING],
  ...[...FILES, ...LIBRARY, ...PEOPLE, ...TIMELINES, ...ROBOTS, ...FLEET],
];

export function Gallery() {
  const wanted = useSyncExternalStore(subscribe, wantedState);
  const locale = useSpokenLocale();
  return (
    <I18nProvider locale={locale}>
      <div className={styles.gallery}>
        <nav className={styles.index} aria-label="States" lang="en">
          <a href={addressOf(null)} onClick={go}>
            All
          </a>
          {EXHIBITS.map(({ name }) => (
            <a key={name} href={addressOf(name)} onClick={go}>
              {name}
            </a>
          ))}
        </nav>
        {EXHIBITS.filter(({ name }) => wanted === null || name === wanted).map((exhibit) => (
          <Shown key={exhibit.name} exhibit={exhibit} />
        ))}
      </div>
    </I18nProvider>
  );
}

function Shown({ exhibit: { name, content, isInDialog = false, stores } }: { readonly exhibit: Exhibit }) {
  const [made] = useState(() => stores?.() ?? specimenStores(FAMILIES.doc));
  return (
    <StoresContext value={made}>
      <FilesProvider>
        <article className={styles.specimen} aria-label={name}>
          <h2 className={styles.name} lang="en">
            {name}
          </h2>
          {isInDialog ? <div className={styles.dialog}>{content}</div> : content}
        </article>
      </FilesProvider>
    </StoresContext>
  );
}

const wantedState = (): string | null => new URLSearchParams(location.search).get('state');

/** Of one state, or of all. */
function addressOf(state: string | null): string {
  const wanted = new URLSearchParams(location.search);
  if (state === null) wanted.delete('state');
  else wanted.set('state', state);
  return `?${wanted.toString()}`;
}

/** Goes to another state without reloading the page. */
function go(event: MouseEvent<HTMLAnchorElement>): void {
  event.preventDefault();
  history.pushState(null, '', event.currentTarget.href);
  dispatchEvent(new PopStateEvent('popstate'));
}

function subscribe(changed: () => void): () => void {
  addEventListener('popstate', changed);
  return () => removeEventListener('popstate', changed);
}
