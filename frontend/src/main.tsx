// The dashboard's entry.

import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { App } from './App.tsx';
import { arrive } from './connect/arrival.ts';
import { openPage } from './connect/page.ts';
import { pair, stopRobot } from './connect/peopleApi.ts';
import { Outside } from './people/Outside.tsx';
import { preferredLanguage, speak } from './words/words.ts';
import './ui/fonts.css';
import './ui/tokens.css';
import './ui/base.css';

const root = document.getElementById('page');
if (root === null) throw new Error('index.html has no #page');
const arrival = await arrive(window);
const role = arrival.me === null ? 'owner' : arrival.me.you?.role;
if (role === undefined || role === 'stopper') await speak(preferredLanguage(navigator.languages));
createRoot(root).render(
  <StrictMode>
    {role === undefined || role === 'stopper' ? (
      <Outside
        mayStop={role === 'stopper'}
        overheard={arrival.me?.overheard ?? false}
        problem={arrival.problem}
        pair={async (wish) => {
          await pair(wish);
          location.reload();
        }}
        stop={stopRobot}
      />
    ) : (
      <App page={await openPage(arrival)} />
    )}
  </StrictMode>,
);
