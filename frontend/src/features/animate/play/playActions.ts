// Playing the group as actions: from the page, on the drawing alone, frame by frame, and by the board; and why each cannot be done now.

import { holdsMotion } from '#shared/group/group.ts';
import { startHindrance } from '../../../robot/readiness.ts';
import type { Stores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { words } from '../../../i18n/whole.ts';
import { playerOf } from './player.ts';

export type PlayContext = Pick<Stores, 'playback' | 'device' | 'document'>;

const phaseOf = ({ playback }: PlayContext) => playback.store.getState().phase;

const isIdle = (context: PlayContext): true | string => phaseOf(context) === null || words.play.needsPause;

const hasMotion = ({ document }: PlayContext): true | string =>
  holdsMotion(document.store.getState().present) || words.board.nothingToDownload;

/** The first reason of several why not; `true` where there is none. */
const each = (...reasons: readonly (true | string)[]): true | string =>
  reasons.find((reason) => reason !== true) ?? true;

/** `true`: something of the group can be sent now. */
export function maySend(context: PlayContext): true | string {
  const { snapshot, family } = context.device.store.getState();
  const { unit } = context.document.store.getState().present;
  const hindrance = startHindrance(snapshot);
  if (hindrance !== null) return words.servos.blocked[hindrance];
  if (family.unit !== unit) return words.actions.otherUnit({ unit: words.units[unit] });
  return hasMotion(context);
}

export const PLAY: Action<PlayContext> = {
  ...{ id: 'play', icon: 'play', keys: [' '] },
  label: (context) => (phaseOf(context) === null ? words.play.play({ times: 1 }) : words.play.pause),
  enabled: (context) => phaseOf(context) !== null || maySend(context),
  run: ({ playback }) => playerOf(playback).toggle(),
};

export const PREVIEW: Action<PlayContext> = {
  ...{ id: 'preview', icon: 'eye', keys: ['Shift+ '] },
  label: (context) => (phaseOf(context) === null ? words.play.preview : words.play.pause),
  enabled: (context) => phaseOf(context) !== null || hasMotion(context),
  run: ({ playback }) => playerOf(playback).togglePreview(),
};

const mayStep = (context: PlayContext): true | string => each(hasMotion(context), isIdle(context));

export const STEP_BACK: Action<PlayContext> = {
  ...{ id: 'stepBack', icon: 'earlier', keys: [','] },
  label: () => words.play.back,
  enabled: mayStep,
  run: ({ playback }) => playerOf(playback).step(-1),
};

export const STEP_FORTH: Action<PlayContext> = {
  ...{ id: 'stepForth', icon: 'later', keys: ['.'] },
  label: () => words.play.forth,
  enabled: mayStep,
  run: ({ playback }) => playerOf(playback).step(1),
};

export const STEPS: readonly Action<PlayContext>[] = [STEP_BACK, STEP_FORTH];

/** Some boards take no groups, others run none: a button for it would never do anything. */
function groupsOfBoard({ device }: PlayContext): true | string {
  const { commands } = device.store.getState().family;
  const absent = (['run', 'download'] as const).find((command) => !commands.includes(command));
  return absent === undefined || words.board.absent[absent];
}

export const canRunOnBoard = (context: PlayContext): boolean => groupsOfBoard(context) === true;

export const RUN_ON_BOARD: Action<PlayContext> = {
  ...{ id: 'runOnBoard', icon: 'board', keys: [] },
  label: () => words.play.onBoard,
  enabled: (context) => each(groupsOfBoard(context), isIdle(context), maySend(context)),
  run: ({ playback }) => playerOf(playback).runOnBoard(),
};

export const PLAY_ACTIONS: readonly Action<PlayContext>[] = [PLAY, PREVIEW, ...STEPS, RUN_ON_BOARD];
