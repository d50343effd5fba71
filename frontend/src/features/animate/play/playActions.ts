// Play and preview as actions of the timeline, and what keeps the group from being played.

import { startHindrance } from '../../../robot/readiness.ts';
import type { Stores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { words } from '../../../i18n/whole.ts';
import { playerOf } from './player.ts';

type PlayContext = Pick<Stores, 'playback' | 'device' | 'document'>;

const phaseOf = ({ playback }: PlayContext) => playback.store.getState().phase;

const hasFrames = ({ document }: PlayContext): true | string =>
  document.store.getState().present.frames.length > 0 || words.board.nothingToDownload;

/** `true`: something of the group can be sent now. */
export function mayPlay(context: PlayContext): true | string {
  const { snapshot, family } = context.device.store.getState();
  const { unit } = context.document.store.getState().present;
  const hindrance = startHindrance(snapshot);
  if (hindrance !== null) return words.servos.blocked[hindrance];
  if (family.unit !== unit) return words.actions.otherUnit({ unit: words.units[unit] });
  return hasFrames(context);
}

export const PLAY: Action<PlayContext> = {
  ...{ id: 'play', icon: 'play', keys: [' '] },
  label: (context) => (phaseOf(context) === null ? words.play.play({ times: 1 }) : words.play.pause),
  enabled: (context) => phaseOf(context) !== null || mayPlay(context),
  run: ({ playback }) => playerOf(playback).toggle(),
};

export const PREVIEW: Action<PlayContext> = {
  ...{ id: 'preview', icon: 'eye', keys: ['Shift+ '] },
  label: (context) => (phaseOf(context) === null ? words.play.preview : words.play.pause),
  enabled: (context) => phaseOf(context) !== null || hasFrames(context),
  run: ({ playback }) => playerOf(playback).togglePreview(),
};
