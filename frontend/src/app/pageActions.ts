// The actions that have their key anywhere on the page, and the one place that listens for these keys. STOP has a listener of its own,
// which nothing keeps a key from.

import { useEffect } from 'react';
import { KEEP_LAST } from '../features/animate/play/TakeDialog.tsx';
import { STOP } from '../features/drive/StopButton.tsx';
import type { Stores } from '../features/stores.ts';
import { workedOn } from '../features/view.ts';
import { REDO, UNDO, type Written } from '../features/undo/UndoTools.tsx';
import { actionOf, chordOf, type Action } from '../ui/action.ts';
import { isTextField } from '../ui/inputEvents.ts';
import { goToPart } from '../ui/focus.ts';
import { words } from '../i18n/words.ts';
import type { Theme } from '../features/view.ts';

/** Where its keys do something; a single sign only where it means nothing else. */
type Reach = 'everywhere' | 'outsideDialogs' | 'outsideFields';

interface PageAction extends Action<Stores> {
  readonly reach: Reach;
}

/** What is written on now; null: nothing. */
function writtenOn({ view, document: group, poses, macros, mappings }: Stores): Written | null {
  const state = view.getState();
  if (state.kiosk === 'on') return null;
  return { group, poses: poses.book, pad: mappings, buttons: macros }[workedOn(state)];
}

function onWritten({ label, enabled, run, ...action }: Action<Written>): PageAction {
  return {
    ...{ ...action, reach: 'outsideFields' },
    label(stores) {
      const written = writtenOn(stores);
      return written === null ? words.actions[action.id === 'undo' ? 'undo' : 'redo'] : label(written);
    },
    enabled(stores) {
      const written = writtenOn(stores);
      return written === null ? words.actions.nothingWritten : enabled(written);
    },
    run(stores) {
      const written = writtenOn(stores);
      if (written !== null) run(written);
    },
  };
}

const PARTS: readonly PageAction[] = [
  {
    ...{ id: 'nextPart', icon: 'later', keys: ['F6'], reach: 'everywhere' },
    label: () => words.actionList.nextPart,
    enabled: () => true,
    run: () => goToPart(1),
  },
  {
    ...{ id: 'previousPart', icon: 'earlier', keys: ['Shift+F6'], reach: 'everywhere' },
    label: () => words.actionList.previousPart,
    enabled: () => true,
    run: () => goToPart(-1),
  },
];

export const LIST_ACTIONS: PageAction = {
  ...{ id: 'actions', icon: 'keyboard', keys: ['Ctrl+k', '?'], reach: 'outsideDialogs' },
  label: () => words.actionList.title,
  enabled: () => true,
  run: ({ view }) => view.setState({ actionsOpen: true }),
};

/** The first press changes what is seen: away from what the system has, then to it, then back to following it. */
function nextTheme(theme: Theme): Theme {
  const system = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  if (theme === system) return 'system';
  return theme === 'system' ? OTHER_THEME[system] : system;
}

const OTHER_THEME = { light: 'dark', dark: 'light' } as const;

export const THEME: Action<Stores, Pick<Stores, 'view'>> = {
  ...{ id: 'theme', icon: 'half', keys: [] },
  label: ({ view }) => words.theme.now({ theme: words.theme[view.getState().theme] }),
  enabled: () => true,
  run: ({ view }) => view.setState({ theme: nextTheme(view.getState().theme) }),
};

const OWN: readonly PageAction[] = [
  onWritten(UNDO),
  onWritten(REDO),
  { ...KEEP_LAST, reach: 'outsideDialogs' },
  LIST_ACTIONS,
  ...PARTS,
];

export const PAGE_ACTIONS: readonly Action<Stores>[] = [STOP, ...OWN, THEME];

const DIALOGS = '[role=dialog], [role=alertdialog], [role=menu]';

/** The key means something else there. On the page of buttons letters start these. */
function isForOthers(reach: Reach, event: KeyboardEvent, { view }: Stores): boolean {
  const { target, repeat } = event;
  const isInDialog = target instanceof Element && target.closest(DIALOGS) !== null;
  if (chordOf(event).length === 1)
    return repeat || isTextField(target) || isInDialog || view.getState().tab === 'buttons';
  return (reach === 'outsideFields' && isTextField(target)) || (reach === 'outsideDialogs' && isInDialog);
}

export function usePageKeys(stores: Stores): void {
  useEffect(() => {
    const press = (event: KeyboardEvent): void => {
      if (event.defaultPrevented) return;
      const isKiosk = stores.view.getState().kiosk === 'on';
      const action = actionOf(isKiosk ? PARTS : OWN, event);
      if (action === undefined || isForOthers(action.reach, event, stores)) return;
      event.preventDefault();
      if (action.enabled(stores) === true) action.run(stores);
    };
    window.addEventListener('keydown', press);
    return () => window.removeEventListener('keydown', press);
  }, [stores]);
}
