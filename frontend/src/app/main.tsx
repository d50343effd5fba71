// The dashboard's entry.

import { StrictMode, type ReactNode } from 'react';
import { createRoot } from 'react-dom/client';
import { App } from './App.tsx';
import { arrive, deviceName } from './arrival.ts';
import { openPage } from './page.ts';
import { pair, sayName, stopRobot } from '../features/people/people.ts';
import { isWithoutGateway } from '../robot/request.ts';
import { preferredLanguage, speak } from '../i18n/words.ts';
import '../ui/fonts.css';
import '../ui/tokens.css';
import '../ui/base.css';

const element = document.getElementById('page');
if (element === null) throw new Error('index.html has no #page');
const root = createRoot(element);
const show = (content: ReactNode): void => root.render(<StrictMode>{content}</StrictMode>);

/** No await of the module itself: parts that are fetched import from it, and would wait for each other. */
async function start(): Promise<void> {
  const arrival = await arrive(window);
  const { me, entered } = arrival;
  const role = me === null ? 'owner' : me.you?.role;
  const suggested = deviceName(navigator.userAgent);
  const isEntryPage = role === undefined || role === 'stopper';
  if (isEntryPage || entered !== null) await speak(preferredLanguage(navigator.languages));

  if (isEntryPage) {
    const { EntryPage } = await import('../features/people/EntryPage.tsx');
    show(
      <EntryPage
        mayStop={role === 'stopper'}
        overheard={me?.overheard ?? false}
        suggested={suggested}
        problem={arrival.problem}
        pair={async (wish) => {
          await pair(wish);
          location.reload();
        }}
        stop={stopRobot}
      />,
    );
  } else if (entered === null) {
    const page = await openPage(arrival);
    show(<App page={page} />);
    if (isWithoutGateway()) {
      const { workOffline } = await import('./offline.ts');
      await workOffline({ notices: page.stores.notices, device: page.stores.device });
    }
  } else {
    const { Guest } = await import('../features/people/EntryPage.tsx');
    show(
      <Guest
        suggested={entered.name}
        enter={async (name) => {
          const you = name === entered.name ? entered : await sayName(name);
          show(<App page={await openPage({ ...arrival, me: me && { ...me, you } })} />);
        }}
      />,
    );
  }
}

void start();
