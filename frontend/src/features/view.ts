// The selection and the settings of this screen, the language among them; neither the robot's state nor a document. The browser remembers
// the look and the kiosk; the browser's tab remembers the current task and calibration. Knows no link.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  calibrationFromText,
  calibrationToText,
  type StoredCalibration,
} from '#shared/profile/calibration.ts';
import { LANGUAGE_CODES, type Language, preferredLanguage, speak, words } from '../i18n/words.ts';
import { readText, saveText, type TextStorage } from '../state/storage.ts';
import { GENTLE_MOVE_MS, type MoveTime } from '../robot/moves.ts';
import { INITIAL_SERVO_VIEW, type ServoView } from './servoView.ts';
import type { Notices } from '../state/notices.ts';

/**
 * `live` is the workspace Drive, `actions` Animate. A wide screen has the log in the workspace of the board, and below the others; a
 * phone has a tab for it.
 */
export type Tab = 'live' | 'actions' | 'board' | 'log' | 'buttons';
export type Theme = 'system' | 'light' | 'dark';
export type LanguageChoice = 'system' | Language;
/** `board`: the units of the board, microseconds or steps. */
export type PositionsIn = 'board' | 'degrees';
/** A list, the places on the body, the robot in three dimensions, or a camera above the list. */
export type ServoLayout = 'list' | 'body' | 'model' | 'camera';
/** The sizes that splitters set: of the sliders beside the robot, of what stands below it, of the sliders beside the timeline or the robot above it, of the log. */
export const SPLITS = ['driveSide', 'driveBelow', 'animateSide', 'animateAbove', 'boardLog'] as const;
export type Split = (typeof SPLITS)[number];
export type LogKind = 'move' | 'group' | 'battery' | 'link' | 'noise';

export interface ViewState {
  readonly tab: Tab;
  readonly theme: Theme;
  readonly language: LanguageChoice;
  /** Shows only buttons and STOP; remembered, so that a reload does not leave the kiosk. */
  readonly kiosk: 'on' | 'off';
  readonly authoring: 'group' | 'poses' | 'pad';
  /** What stands below the robot in Drive. */
  readonly driveBelow: 'none' | 'poses' | 'pad';
  /** In pixels; a part that is absent has its usual size. */
  readonly splits: Readonly<Partial<Record<Split, number>>>;
  readonly connectOpen: boolean;
  readonly libraryOpen: boolean;
  readonly peopleOpen: boolean;
  /** The dialog with all actions. */
  readonly actionsOpen: boolean;
  /** The open view of the dialog of robots; null if it is closed. */
  readonly robotView: 'list' | 'edit' | 'calibrate' | null;
  /** The progress of one robot's calibration, which survives a reload. */
  readonly calibration: StoredCalibration | null;
  readonly logOpen: boolean;
  readonly logKinds: readonly LogKind[];
  /** The cards of frames below the timeline of a wide screen. */
  readonly frameCards: 'shown' | 'folded';
  /** What a desktop has with the timeline in Animate: the sliders beside it, or the robot above it, so that it has the full width. */
  readonly animateWith: 'sliders' | 'robot';
  readonly selectedFrame: number | null;
  /** Each press adds a frame or key to the selection or removes it, for fingers, which have no Ctrl key. */
  readonly addsToSelection: boolean;
  /** Of groups that have one, on this computer. */
  readonly sound: 'on' | 'muted';
  readonly servos: ServoView;
  readonly positionsIn: PositionsIn;
  readonly servoLayout: ServoLayout;
  /** The robot in Drive, on a wide screen; `auto`: the model, where the machine draws one fast. */
  readonly picture: 'auto' | 'drawing' | 'body' | 'model' | 'camera';
  /** The name of the camera at the gateway that was chosen last. */
  readonly camera: string;
  /** This computer's camera is shown; switched on by a press only, so a reload forgets it. */
  readonly cameraHere: boolean;
  readonly selectedPose: number | null;
  /** The duration of a move to a pose. */
  readonly poseMs: number;
  readonly selectedButton: number | null;
  readonly editsButtons: boolean;
  readonly moveTime: MoveTime;
  /** The slot chosen for the open group; null for the automatic one. */
  readonly slot: number | null;
  readonly times: number;
  readonly untilStopped: boolean;
  /** The next run may continue without this page; reset after each run. */
  readonly keepsRunning: boolean;
  /** The longest time without this page. */
  readonly keepRunningMinutes: number;
}

export type View = StoreApi<ViewState>;

interface Memory<Value> {
  readonly by: keyof Memories;
  readonly key: string;
  toText(value: Value): string;
  /** undefined for a text that this page did not write. */
  fromText(text: string): Value | undefined;
}

const choice = <Value extends string>(
  by: keyof Memories,
  key: string,
  values: readonly Value[],
): Memory<Value> => ({
  ...{ by, key },
  toText: (value) => value,
  fromText: (text) => values.find((value) => value === text),
});

/** How each remembered value is stored. The current task survives a reload in its tab only. */
const REMEMBERED: { readonly [K in keyof ViewState]?: Memory<ViewState[K]> } = {
  theme: choice('browser', 'servodeck.view', ['system', 'light', 'dark']),
  language: choice('browser', 'servodeck.language', ['system', ...LANGUAGE_CODES]),
  positionsIn: choice('browser', 'servodeck.positionsIn', ['board', 'degrees']),
  kiosk: choice('browser', 'servodeck.kiosk', ['on', 'off']),
  servoLayout: choice('browser', 'servodeck.servoLayout', ['list', 'body', 'model', 'camera']),
  tab: choice('tab', 'servodeck.tab', ['live', 'actions', 'board', 'log', 'buttons']),
  picture: choice('browser', 'servodeck.picture', ['auto', 'drawing', 'body', 'model', 'camera']),
  authoring: choice('tab', 'servodeck.authoring', ['group', 'poses', 'pad']),
  frameCards: choice('browser', 'servodeck.frameCards', ['shown', 'folded']),
  animateWith: choice('browser', 'servodeck.animateWith', ['sliders', 'robot']),
  sound: choice('browser', 'servodeck.sound', ['on', 'muted']),
  driveBelow: choice('tab', 'servodeck.driveBelow', ['none', 'poses', 'pad']),
  camera: { by: 'browser', key: 'servodeck.camera', toText: String, fromText: String },
  splits: { by: 'browser', key: 'servodeck.splits', toText: JSON.stringify, fromText: splitsFromText },
  calibration: {
    ...{ by: 'tab', key: 'servodeck.calibration' },
    ...{ toText: calibrationToText, fromText: calibrationFromText },
  },
};

/** The browser's storage for all visits, and the one of its tab. */
export interface Memories {
  readonly browser: TextStorage;
  readonly tab: TextStorage;
}

export const INITIAL_VIEW: ViewState = {
  tab: 'live',
  theme: 'system',
  language: 'system',
  kiosk: 'off',
  authoring: 'group',
  driveBelow: 'none',
  splits: {},
  connectOpen: false,
  libraryOpen: false,
  peopleOpen: false,
  actionsOpen: false,
  robotView: null,
  calibration: null,
  logOpen: false,
  logKinds: ['move', 'group', 'battery', 'link', 'noise'],
  frameCards: 'shown',
  animateWith: 'sliders',
  selectedFrame: null,
  addsToSelection: false,
  sound: 'on',
  servos: INITIAL_SERVO_VIEW,
  positionsIn: 'board',
  servoLayout: 'list',
  picture: 'auto',
  camera: '',
  cameraHere: false,
  selectedPose: null,
  poseMs: GENTLE_MOVE_MS,
  selectedButton: null,
  editsButtons: false,
  moveTime: 'hand',
  slot: null,
  times: 1,
  untilStopped: false,
  keepsRunning: false,
  keepRunningMinutes: 10,
};

/** What undo and the keys of lists apply to. */
export function workedOn({
  tab,
  authoring,
  driveBelow,
}: Pick<ViewState, 'tab' | 'authoring' | 'driveBelow'>): ViewState['authoring'] | 'buttons' {
  if (tab === 'buttons') return tab;
  return tab === 'live' && driveBelow !== 'none' ? driveBelow : authoring;
}

export function createView(memories: Memories): View {
  const remembered = Object.entries(REMEMBERED).map(([name, memory]) =>
    createMemory(memories, name as keyof ViewState, memory as Memory<unknown>),
  );
  const view = createStore<ViewState>(() => ({
    ...INITIAL_VIEW,
    ...Object.fromEntries(remembered.flatMap(({ load }) => load())),
  }));
  view.subscribe((state, before) => {
    for (const { save } of remembered) save(state, before);
  });
  return view;
}

function createMemory(memories: Memories, name: keyof ViewState, memory: Memory<unknown>) {
  const storage = memories[memory.by];
  return {
    load(): readonly (readonly [keyof ViewState, unknown])[] {
      const value = memory.fromText(readText(storage, memory.key) ?? '');
      return value === undefined ? [] : [[name, value]];
    },
    save(state: ViewState, before: ViewState): void {
      if (state[name] !== before[name]) saveText(storage, memory.key, memory.toText(state[name]));
    },
  };
}

function splitsFromText(text: string): ViewState['splits'] | undefined {
  try {
    const sizes = new Map<string, unknown>(Object.entries(Object(JSON.parse(text)) as object));
    const known = SPLITS.map((split) => [split, sizes.get(split)] as const);
    return Object.fromEntries(known.filter(([, size]) => typeof size === 'number'));
  } catch {
    return undefined;
  }
}

interface LanguageOptions {
  readonly view: View;
  readonly notices: Notices;
  /** As `navigator.languages`. */
  readonly tags: readonly string[];
}

/** Resolves once the first one is spoken, so that nothing is named in another. */
export async function followLanguage({ view, notices, tags }: LanguageOptions): Promise<void> {
  async function follow(): Promise<void> {
    const { language } = view.getState();
    await speak(language === 'system' ? preferredLanguage(tags) : language).catch(() =>
      notices.show('warning', words.language.notLoaded),
    );
  }
  view.subscribe((state, before) => {
    if (state.language !== before.language) void follow();
  });
  await follow();
}
