// The page's messages, and the log where it has a place of its own.

import { useStore } from 'zustand';
import { laterComponent } from '../../ui/later.tsx';
import { useStores } from '../stores.ts';
import { Toasts } from '../../ui/Toasts.tsx';
import { words } from '../../i18n/words.ts';

export const LogPanel = laterComponent(async () => (await import('./LogPanel.tsx')).LogPanel, '100%');

export function Messages() {
  const { notices } = useStores();
  const list = useStore(notices.store);
  return (
    <Toasts
      label={words.regions.notices}
      dismissLabel={words.dismiss}
      moreLabel={(count) => words.moreNotices({ count })}
      toasts={list.map(({ tone, ...notice }) => ({ ...notice, truth: tone === 'info' ? 'neutral' : tone }))}
      onDismiss={notices.dismiss}
    />
  );
}
