// The whole log, which comes when it is wanted.

import { laterComponent } from '../../ui/later.tsx';

export const LogPanel = laterComponent(async () => (await import('./LogPanel.tsx')).LogPanel, '100%');
