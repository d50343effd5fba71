// The entry of the fleet page. Who is not let in is sent to the dashboard, which pairs.

import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { preferredLanguage, speak } from '../i18n/words.ts';
import { gatewayStore } from '../features/library/gatewayStore.ts';
import { readMe } from '../features/people/people.ts';
import { browserClock } from '../robot/links/browserClock.ts';
import { gatewayFleet } from '../fleet/fleetApi.ts';
import { FleetPage } from '../fleet/FleetPage.tsx';
import { createFleet, type Fleet } from '../fleet/fleetStore.ts';
import { readText, saveText, storageOf } from '../state/storage.ts';
import '../ui/fonts.css';
import '../ui/tokens.css';
import '../ui/base.css';

const element = document.getElementById('page');
if (element === null) throw new Error('fleet.html has no #page');
const root = createRoot(element);

const CUE_KEY = 'servodeck.fleet.cue';

/** A page that is loaded again in the middle of a show goes on there. */
function keepPlace({ store }: Fleet): void {
  const storage = storageOf(() => window.sessionStorage);
  store.setState({ nextCue: Number(readText(storage, CUE_KEY)) || 0 });
  store.subscribe(({ nextCue }, before) => {
    if (nextCue !== before.nextCue) saveText(storage, CUE_KEY, String(nextCue));
  });
}

async function start(): Promise<void> {
  await speak(preferredLanguage(navigator.languages));
  const me = await readMe();
  const role = me === null ? null : me.you?.role;
  if (role === undefined || role === 'stopper') {
    location.replace('./');
    return;
  }
  const fleet = createFleet(gatewayFleet, gatewayStore, browserClock);
  keepPlace(fleet);
  root.render(
    <StrictMode>
      <FleetPage
        fleet={fleet}
        mayDrive={role === 'driver' || role === 'owner'}
        hasOwnRobot={me?.pages.includes('robot') === true}
      />
    </StrictMode>,
  );
  await fleet.follow(new AbortController().signal);
}

void start();
