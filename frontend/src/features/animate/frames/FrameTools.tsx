// What can be done with the selected frames, in words. Always in its place, so that nothing jumps when a frame is selected.

import { indexOfFrame } from '#shared/group/groupEdits.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useDevice, useDocument, useSnapshot, useStores, useTimeline, useView } from '../../stores.ts';
import { ActionButton, ActionIconButton } from '../../../ui/ActionButton.tsx';
import { words } from '../../../i18n/whole.ts';
import { AddsSwitch } from '../timeline/TimelineTools.tsx';
import { useWholeFrames } from '../timeline/wholeFrames.ts';
import { FRAME_ACTIONS, frameContextOf, type FrameContext } from './frameActions.ts';
import { together } from './frameVerbs.ts';
import { useKnowsPose } from './CaptureButton.tsx';
import styles from './FrameTools.module.css';

const ICONS = [
  ['before', 'after', 'earlier', 'later', 'duplicate'],
  ['cut', 'copy', 'paste', 'remove'],
] as const;

export function FrameTools() {
  const shown = useFrameContext();
  const { stores, id, ids } = shown;
  const context = (): FrameContext => frameContextOf(stores);
  const index = useDocument(({ present }) => indexOfFrame(present, id ?? -1));
  return (
    <div className={styles.tools} role="group" aria-label={words.actions.tools}>
      <span className={styles.which}>
        {id === null
          ? words.actions.select
          : ids.length > 1
            ? words.actions.several({ count: ids.length })
            : words.actions.frame({ number: index + 1 })}
      </span>
      <AddsSwitch />
      <ActionButton tone="quiet" action={FRAME_ACTIONS.load} {...{ shown, context }} />
      <ActionButton tone="quiet" action={FRAME_ACTIONS.update} {...{ shown, context }} />
      {ICONS.map((names) => (
        <span key={names[0]} className={styles.icons}>
          {names.map((name) => (
            <ActionIconButton key={name} action={FRAME_ACTIONS[name]} {...{ shown, context }} />
          ))}
        </span>
      ))}
    </div>
  );
}

/** Drawn again whenever something changes that the actions look at. */
function useFrameContext(): FrameContext {
  const stores = useStores();
  const selected = useView((state) => state.selectedFrame);
  const whole = useWholeFrames();
  useKnowsPose();
  useSnapshot(motionHindrance);
  useDevice((state) => state.family);
  useTimeline(({ clip }) => clip !== null);
  useDocument(({ present }) => present.unit);
  useDocument(({ present }) => [present.frames[0]?.id, present.frames.at(-1)?.id].join());
  const isThere = useDocument(({ present }) => indexOfFrame(present, selected ?? -1) >= 0);
  return isThere && selected !== null
    ? { stores, id: selected, ids: together(whole, selected) }
    : { stores, id: null, ids: [] };
}
