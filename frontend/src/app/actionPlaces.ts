// All actions of the page and the keys that stand in no list of actions, by the place in which their keys work: for the list of all
// actions, and for the tests that hold for each of them.

import { FRAME_ACTIONS, FRAME_KEYS, frameContextOf } from '../features/animate/frames/frameActions.ts';
import { PLAY_ACTIONS } from '../features/animate/play/playActions.ts';
import { contextOf } from '../features/animate/timeline/context.ts';
import {
  COLOUR_ACTIONS,
  EASING_ACTIONS,
  MENU_KEYS,
  ROW_ACTIONS,
  TIMELINE_ACTIONS,
  TIMELINE_KEYS,
} from '../features/animate/timeline/timelineActions.ts';
import { MACRO_ACTIONS, macroContextOf } from '../features/buttons/macroActions.ts';
import { POSE_ACTIONS, poseContextOf } from '../features/poses/poseActions.ts';
import type { Stores } from '../features/stores.ts';
import { workedOn } from '../features/view.ts';
import type { Action, KeyUse } from '../ui/action.ts';
import { walkKeys } from '../ui/cards.ts';
import { words, type Words } from '../i18n/whole.ts';
import { PAGE_ACTIONS } from './pageActions.ts';

/** An action as it is now, in the words of the moment. */
export interface ListedAction extends Pick<Action<never>, 'id' | 'icon' | 'keys'> {
  readonly label: string;
  readonly enabled: true | string;
  run(): void;
}

type ListedKeys = Pick<KeyUse<never>, 'id' | 'keys' | 'label'>;

export interface ActionPlace {
  readonly id: keyof Words['actionList']['places'];
  actions(stores: Stores): readonly ListedAction[];
  readonly keys: readonly ListedKeys[];
}

/** `where`: `true` where the place is on the page now, else how it is opened. */
function listed<Context extends Shown, Shown>(
  actions: readonly Action<Context, Shown>[],
  context: () => Context,
  where: true | string = true,
): readonly ListedAction[] {
  const now = context();
  return actions.map(({ id, icon, keys, label, enabled, run }) => ({
    ...{ id, icon, keys },
    label: label(now),
    enabled: where === true ? enabled(now) : where,
    run: () => run(context()),
  }));
}

function isOpen({ view }: Stores, authoring: 'group' | 'poses'): true | string {
  return (
    workedOn(view.getState()) === authoring ||
    words.actionList.elsewhere({ place: words.authoring[authoring] })
  );
}

const areEdited = ({ view }: Stores): true | string => {
  const { tab, editsButtons } = view.getState();
  return (
    (tab === 'buttons' && editsButtons) ||
    words.actionList.elsewhere({ place: words.actionList.places.buttons })
  );
};

export const ACTION_PLACES: readonly ActionPlace[] = [
  { id: 'page', keys: [], actions: (stores) => listed(PAGE_ACTIONS, () => stores) },
  {
    ...{ id: 'timeline', keys: [...TIMELINE_KEYS, MENU_KEYS] },
    actions: (stores) => [
      ...listed(PLAY_ACTIONS, () => stores, isOpen(stores, 'group')),
      ...listed(
        [...Object.values(TIMELINE_ACTIONS), ...EASING_ACTIONS, ...COLOUR_ACTIONS],
        () => contextOf(stores),
        isOpen(stores, 'group'),
      ),
    ],
  },
  {
    ...{ id: 'row', keys: [] },
    actions: (stores) => listed(Object.values(ROW_ACTIONS), () => contextOf(stores), isOpen(stores, 'group')),
  },
  {
    ...{ id: 'frames', keys: FRAME_KEYS },
    actions: (stores) =>
      listed(Object.values(FRAME_ACTIONS), () => frameContextOf(stores), isOpen(stores, 'group')),
  },
  {
    ...{ id: 'poses', keys: [walkKeys()] },
    actions: (stores) =>
      listed(Object.values(POSE_ACTIONS), () => poseContextOf(stores), isOpen(stores, 'poses')),
  },
  {
    ...{ id: 'buttons', keys: [walkKeys()] },
    actions: (stores) =>
      listed(Object.values(MACRO_ACTIONS), () => macroContextOf(stores), areEdited(stores)),
  },
];
