// Something above the tracks that is dragged through time, or moved by the arrow keys: one step of the history for each drag, shown while it
// lasts, cancelled by Escape, a lost pointer and a lost window. Knows not what it moves.

import { useEffect, useRef, type KeyboardEvent, type PointerEvent } from 'react';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Label } from '#shared/document/history.ts';
import { useGroupBoard, useStores } from '../../stores.ts';
import { contextOf } from './context.ts';
import { restingPlace } from './gesture.ts';

interface TimeDragOptions {
  /** Where it is now. */
  readonly startMs: number;
  readonly label: Label;
  /** The edit that brings it there. */
  moved(startMs: number): (group: ActionGroup) => ActionGroup;
  /** The beats of the group's sound hold it too. */
  readonly onBeats?: boolean;
  /** Left out: at something of the group, else on the board's raster. */
  rest?(wantedMs: number): number;
  /** Pressed and released in its place. */
  onPress?(): void;
  /** After a step by a key. */
  onStep?(startMs: number): void;
}

interface Drag {
  readonly x: number;
  readonly startMs: number;
  hasMoved: boolean;
}

/** Steps with Shift. */
const FAR = 10;
/** Less is a press. */
const PRESS_PX = 4;

export function useTimeDrag(options: TimeDragOptions) {
  const { startMs, label, moved, rest, onBeats = false, onPress, onStep } = options;
  const stores = useStores();
  const { document, timeline } = stores;
  const { tickMs } = useGroupBoard().family.motion;
  const from = useRef<Drag | null>(null);

  function move({ clientX, altKey }: PointerEvent): void {
    const begun = from.current;
    if (begun === null) return;
    const px = clientX - begun.x;
    const wanted = begun.startMs + px * timeline.getState().time.msPerPx;
    const next = rest?.(wanted) ?? restingPlace(contextOf(stores), wanted, { isFree: altKey, onBeats });
    if (!begun.hasMoved && (next === begun.startMs || Math.abs(px) < PRESS_PX)) return;
    if (!begun.hasMoved) document.begin(label);
    begun.hasMoved = true;
    document.preview(moved(next));
  }

  function end(commits: boolean): void {
    const begun = from.current;
    from.current = null;
    if (begun?.hasMoved === true) {
      if (commits) document.commit();
      else document.cancel();
    } else if (begun !== null && commits) onPress?.();
  }

  function key(event: KeyboardEvent): void {
    const ticks = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (ticks === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const next = startMs + ticks * tickMs * (event.shiftKey ? FAR : 1);
    document.edit(label, moved(next));
    onStep?.(next);
  }

  useEffect(() => {
    const callOff = (): void => end(false);
    const escape = ({ key: name }: globalThis.KeyboardEvent): void => {
      if (name === 'Escape') callOff();
    };
    window.addEventListener('blur', callOff);
    window.addEventListener('keydown', escape, { capture: true });
    return () => {
      window.removeEventListener('blur', callOff);
      window.removeEventListener('keydown', escape, { capture: true });
    };
  });

  return {
    onKeyDown: key,
    onPointerDown(event: PointerEvent): void {
      if (event.button !== 0) return end(false);
      event.currentTarget.setPointerCapture(event.pointerId);
      from.current = { x: event.clientX, startMs, hasMoved: false };
    },
    onPointerMove: move,
    onPointerUp: () => end(true),
    onPointerCancel: () => end(false),
  };
}
