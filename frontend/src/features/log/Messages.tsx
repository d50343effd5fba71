// What the page has to tell the person, wherever a part of the page has room for it.

import { useStore } from 'zustand';
import { useStores } from '../stores.ts';
import { Toasts } from '../../ui/Toasts.tsx';
import { words } from '../../i18n/words.ts';

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
