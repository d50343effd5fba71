// The frames in order, one card each, for people who think in poses. The frame that plays is marked, and those that are selected
// in the timeline.

import { useEffect, useEffectEvent, type RefObject, useState, useMemo, type CSSProperties } from 'react';
import { indexOfFrame } from '#shared/group/groupEdits.ts';
import { useStores, usePlayedFrame } from '../../stores.ts';
import { clipFromText, clipToText } from '../timeline/clipText.ts';
import { createStripKeys } from './frameActions.ts';
import { copy, cut, paste, togetherNow, useWholeFrames } from './frameVerbs.ts';
import { cardOf, useCards } from '../../../ui/cards.ts';
import { showFrame } from '../timeline/inStep.ts';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { words } from '../../../i18n/whole.ts';
import { FrameCard } from './FrameCard.tsx';
import styles from './FrameStrip.module.css';
import type { Frame } from '#shared/codec/commands.ts';
import { poseAt } from '#shared/group/group.ts';
import { sameLook, samePose } from '../../picture/pose.ts';

// Copy, cut and paste of the system while a card of the strip has the focus. The events go to wherever the browser
// thinks text would be, so they are heard for the whole page.

/** `changed`: a card may have gone that had the focus. */
function useStripClipboard(list: RefObject<HTMLElement | null>, changed: () => void): void {
  const stores = useStores();
  const tellChanged = useEffectEvent(changed);
  useEffect(() => {
    const { document } = window;
    const ended = new AbortController();
    const hear = (type: 'copy' | 'cut' | 'paste', act: (data: DataTransfer, id: number) => void): void =>
      document.addEventListener(
        type,
        (event) => {
          const { activeElement } = document;
          const id = list.current?.contains(activeElement) ? cardOf(activeElement, 'data-frame') : null;
          if (id === null || event.clipboardData === null) return;
          act(event.clipboardData, id);
          event.preventDefault();
          tellChanged();
        },
        { signal: ended.signal },
      );
    const put = (data: DataTransfer, clip: ReturnType<typeof copy>): void => {
      if (clip !== null) data.setData('text/plain', clipToText(clip));
    };
    hear('copy', (data, id) => put(data, copy(stores, togetherNow(stores, id))));
    hear('cut', (data, id) => put(data, cut(stores, togetherNow(stores, id))));
    hear('paste', (data) => {
      const text = data.getData('text/plain');
      paste(stores, (text === '' ? null : clipFromText(text)) ?? stores.timeline.getState().clip);
    });
    return () => ended.abort();
  }, [stores, list]);
}

// Which cards of a long strip are there: those in sight and some on both sides, so that a few hundred cost no more
// than a few dozen. The others keep their space.

/** A card and the gap behind it; the style sheet says the same. */
const STEP_PX = 140;
const BESIDE = 4;
/** So many are always there: what is short need not be clever. */
const SHORT = 40;
/** The window moves in steps: not each pixel that is scrolled draws the strip again. */
const CHUNK = 8;

interface StripWindow {
  readonly first: number;
  readonly end: number;
  readonly roomBeforePx: number;
  readonly roomBehindPx: number;
}

function useStripWindow(strip: RefObject<HTMLElement | null>, count: number, shown: number): StripWindow {
  const [seen, setSeen] = useState({ first: 0, end: CHUNK });

  useEffect(() => {
    const element = strip.current;
    if (element === null) return undefined;
    const measure = (): void => {
      const chunks = (px: number): number => px / STEP_PX / CHUNK;
      const first = Math.floor(chunks(element.scrollLeft)) * CHUNK;
      const end = Math.ceil(chunks(element.scrollLeft + element.clientWidth)) * CHUNK;
      setSeen((before) => (before.first === first && before.end === end ? before : { first, end }));
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    element.addEventListener('scroll', measure);
    return () => {
      observer.disconnect();
      element.removeEventListener('scroll', measure);
    };
  }, [strip]);

  useEffect(() => {
    const element = strip.current;
    if (element === null || shown < 0) return;
    const left = shown * STEP_PX;
    const right = left + 1.25 * STEP_PX - element.clientWidth;
    if (left < element.scrollLeft || right > element.scrollLeft)
      element.scrollTo({ left: left < element.scrollLeft ? left : right });
  }, [strip, shown]);

  const isShort = count <= SHORT;
  const first = isShort ? 0 : Math.max(0, Math.min(seen.first, count) - BESIDE);
  const end = isShort ? count : Math.min(count, seen.end + BESIDE);
  return { first, end, roomBeforePx: first * STEP_PX, roomBehindPx: (count - end) * STEP_PX };
}

const ATTRIBUTE = 'data-frame';

export function FrameStrip() {
  const stores = useStores();
  const group = useInFrame(stores.document.store, ({ present }) => present);
  const selected = useInFrame(stores.view, (state) => state.selectedFrame);
  const playing = usePlayedFrame();
  const whole = useWholeFrames();
  const [act] = useState(() => createStripKeys(stores));
  const { list, tabStop, key, focusSelected } = useCards<HTMLOListElement>({
    ...{ ids: group.frames.map(({ id }) => id), selected, attribute: ATTRIBUTE },
    select: (id) => showFrame(stores, id),
    act,
  });
  useStripClipboard(list, focusSelected);

  const { first, end, roomBeforePx, roomBehindPx } = useStripWindow(
    list,
    group.frames.length,
    indexOfFrame(group, selected ?? -1),
  );
  const poses = useMemo(() => framePoses(group.frames, first, end), [group.frames, first, end]);

  return (
    <ol
      ref={list}
      className={styles.strip}
      aria-label={words.actions.frames}
      onKeyDown={key}
      style={roomOf(roomBeforePx, roomBehindPx)}
    >
      {group.frames.slice(first, end).map((frame, index) => (
        <FrameCard
          key={frame.id}
          {...{ frame, index: first + index, ...(poses[index] ?? NO_POSE) }}
          isSelected={frame.id === selected}
          isAmongSelected={whole.length > 1 && whole.includes(frame.id)}
          isTabStop={frame.id === tabStop}
          isPlaying={playing === first + index}
        />
      ))}
    </ol>
  );
}

const roomOf = (beforePx: number, behindPx: number): CSSProperties => ({
  ['--before' as string]: `${beforePx}px`,
  ['--behind' as string]: `${behindPx}px`,
});

const NO_POSE = { pose: new Map<number, number>(), changed: [] };

// The pose after each of some frames that follow each other, and which servos moved to get there, in one pass. Pure.

export interface FramePose {
  readonly pose: ReadonlyMap<number, number>;
  /** In ascending order. */
  readonly changed: readonly number[];
}

type Pose = FramePose['pose'];

interface Step {
  readonly from: Pose;
  readonly to: FramePose;
}

const known = new WeakMap<Frame, Step>();

/** The very same ones as before as long as they say the same: an edit of one frame has nothing done for dozens of others. */
export function framePoses(frames: readonly Frame[], first: number, end: number): readonly FramePose[] {
  let from: Pose = poseAt(frames, first - 1);
  return frames.slice(first, end).map((frame) => {
    const to = stepFrom(from, frame);
    from = to.pose;
    return to;
  });
}

function stepFrom(from: Pose, frame: Frame): FramePose {
  const before = known.get(frame);
  if (before !== undefined && samePose(before.from, from)) return before.to;
  const made = newStep(from, frame);
  const to = before !== undefined && sameLook(before.to, made) ? before.to : made;
  known.set(frame, { from, to });
  return to;
}

function newStep(from: Pose, { targets }: Frame): FramePose {
  const pose = new Map(from);
  for (const { servo, position } of targets) pose.set(servo, position);
  const changed = [...pose.keys()].filter((servo) => from.get(servo) !== pose.get(servo));
  return { pose, changed: changed.sort((one, other) => one - other) };
}
