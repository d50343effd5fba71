// The dashboard's entry.

import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { App } from './App.tsx';
import { openPage } from './connect/page.ts';
import './ui/fonts.css';
import './ui/tokens.css';
import './ui/base.css';

const root = document.getElementById('page');
if (root === null) throw new Error('index.html has no #page');
const page = await openPage();
createRoot(root).render(
  <StrictMode>
    <App page={page} />
  </StrictMode>,
);
