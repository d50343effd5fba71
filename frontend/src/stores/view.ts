// What is selected, open and set on this screen: neither the robot's state nor the document's. The theme is
// remembered. Knows no link.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Calibration } from '#shared/actions/robotCalibration.ts';
import type { TextStorage } from './document.ts';
import type { MoveTime } from './moveTime.ts';

export type Tab = 'live' | 'actions' | 'board' | 'log';
export type Theme = 'system' | 'light' | 'dark';
export type LogKind = 'move' | 'group' | 'battery' | 'link' | 'noise';

export interface ViewState {
  readonly tab: Tab;
  readonly theme: Theme;
  readonly connectOpen: boolean;
  /** What of the robots is open; null: nothing. */
  readonly robotView: 'list' | 'edit' | 'calibrate' | null;
  /** How far the calibration of one robot, by its id, has come. */
  readonly calibration: { readonly robotId: number; readonly progress: Calibration } | null;
  readonly logOpen: boolean;
  readonly logKinds: readonly LogKind[];
  readonly selectedFrame: number | null;
  readonly selectedServo: number | null;
  /** The frame to play from, as an index: where the last playing was paused. */
  readonly playFrom: number;
  readonly moveTime: MoveTime;
  readonly slot: number;
  readonly times: number;
  readonly untilStopped: boolean;
  /** The latest change that only the eye could see, for screen readers. */
  readonly said: string;
}

export type View = StoreApi<ViewState>;

const KEY = 'servodeck.view';
const THEMES: readonly string[] = ['system', 'light', 'dark'] satisfies Theme[];

export const INITIAL_VIEW: ViewState = {
  tab: 'live',
  theme: 'system',
  connectOpen: false,
  robotView: null,
  calibration: null,
  logOpen: false,
  logKinds: ['move', 'group', 'battery', 'link', 'noise'],
  selectedFrame: null,
  selectedServo: null,
  playFrom: 0,
  moveTime: 'hand',
  slot: 0,
  times: 1,
  untilStopped: false,
  said: '',
};

export function createView(storage: TextStorage): View {
  const view = createStore<ViewState>(() => ({ ...INITIAL_VIEW, theme: loadTheme(storage) }));
  view.subscribe(({ theme }, before) => {
    if (theme !== before.theme) saveTheme(storage, theme);
  });
  return view;
}

function loadTheme(storage: TextStorage): Theme {
  try {
    const theme = storage.getItem(KEY);
    return theme !== null && THEMES.includes(theme) ? (theme as Theme) : 'system';
  } catch {
    return 'system';
  }
}

function saveTheme(storage: TextStorage, theme: Theme): void {
  try {
    storage.setItem(KEY, theme);
  } catch {
    // Storage is forbidden here: the choice lasts as long as the page, and that is all it is worth.
  }
}
