// A slider's value under a pointer, at each report of it: browsers keep `input` back until the next frame, which makes it up to
// 17 ms old when the wire is free for it, and a native thumb that moves has the whole page laid out and painted anew. So the
// slider has none, and this is what a pointer does to it. A finger has to take the thumb, and sideways: scrolling past a slider
// never moves a servo.

import { useEffect, useEffectEvent, type RefObject, useRef } from 'react';
import type { Range } from '#shared/codec/families.ts';

// The wheel as a way to step: only over something that has the focus and may be stepped now, so that scrolling past a
// servo never moves it. Everywhere else it scrolls.

/** Less than one notch of any common wheel; a touch pad sends many small parts. */
const NOTCH_PX = 50;

interface WheelSteps {
  mayStep(): boolean;
  step(change: 1 | -1, isFar: boolean): void;
}

export function useWheelSteps(area: RefObject<HTMLElement | null>, { mayStep, step }: WheelSteps): void {
  const mayStepNow = useEffectEvent(mayStep);
  const stepNow = useEffectEvent(step);
  useEffect(() => {
    const element = area.current;
    if (element === null) return;
    let turnedPx = 0;
    function turn(event: WheelEvent): void {
      // With Ctrl it is the browser's zoom.
      if (event.ctrlKey || !mayStepNow()) return;
      event.preventDefault();
      // With Shift browsers turn the wheel sideways.
      const delta = event.deltaY === 0 ? event.deltaX : event.deltaY;
      turnedPx += event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? delta : Math.sign(delta) * NOTCH_PX;
      if (Math.abs(turnedPx) < NOTCH_PX) return;
      stepNow(turnedPx < 0 ? 1 : -1, event.shiftKey);
      turnedPx = 0;
    }
    const listen = (): void => element.addEventListener('wheel', turn, { passive: false });
    const ignore = (): void => element.removeEventListener('wheel', turn);
    element.addEventListener('focusin', listen);
    element.addEventListener('focusout', ignore);
    return () => {
      ignore();
      element.removeEventListener('focusin', listen);
      element.removeEventListener('focusout', ignore);
    };
  }, [area]);
}

// Where on its way a slider's thumb stands, where a pointer takes hold of it, and which value it gives it then.

/** What the middle of the thumb goes along, and the values at its ends. */
export interface Way extends Range {
  readonly fromPx: number;
  readonly lengthPx: number;
}

export function valueAt({ fromPx, lengthPx, min, max }: Way, atPx: number): number {
  const share = Math.min(1, Math.max(0, (atPx - fromPx) / lengthPx));
  return min + Math.round(share * (max - min));
}

export function placeOf({ fromPx, lengthPx, min, max }: Way, value: number): number {
  return fromPx + ((value - min) / (max - min || 1)) * lengthPx;
}

export interface Press {
  readonly atPx: number;
  /** The thumb takes it so far beside its middle. */
  readonly reachPx: number;
  /** It may be there to scroll. */
  readonly isFinger: boolean;
}

/** How far beside the thumb's middle it holds the thumb, which stands at `value`. null: a finger that only brushes the slider. */
export function gripOf(way: Way, value: number, { atPx, reachPx, isFinger }: Press): number | null {
  const besidePx = atPx - placeOf(way, value);
  if (Math.abs(besidePx) <= reachPx) return besidePx;
  return isFinger ? null : 0;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** Beyond what a finger trembles. */
const TREMBLE_PX = 6;

/** A finger that goes there drags; up or down it scrolls. */
export function isSideways(from: Point, to: Point): boolean {
  const [x, y] = [Math.abs(to.x - from.x), Math.abs(to.y - from.y)];
  return x > TREMBLE_PX && x > y;
}

/** Below the shortest packet with its gap: reports in between would be overtaken before they leave. */
const REPORT_EACH_MS = 4;

/** Half of what is large enough for a finger. */
const FINGER_REACH_PX = 22;

/** `brushed`: a finger is on it that has not moved the thumb. */
export type Hold = 'free' | 'held' | 'brushed';

interface Drag {
  /** Where the thumb stands. */
  shown(): number;
  drag(value: number): void;
  release(): void;
  /** By a finger on the thumb alone. */
  pressTwice(): void;
}

export function useDrag(input: RefObject<HTMLInputElement | null>, drag: Drag): Readonly<RefObject<Hold>> {
  const hold = useRef<Hold>('free');
  const shown = useEffectEvent(drag.shown);
  const move = useEffectEvent(drag.drag);
  const release = useEffectEvent(drag.release);
  const pressTwice = useEffectEvent(drag.pressTwice);
  useEffect(() => {
    const slider = input.current;
    if (slider === null) return undefined;
    return followPointer(slider, hold, {
      shown: () => shown(),
      drag: (value) => move(value),
      release: () => release(),
      pressTwice: () => pressTwice(),
    });
  }, [input]);
  return hold;
}

interface Grip {
  readonly pointer: number;
  readonly way: Way;
  /** How far beside the thumb's middle. */
  readonly besidePx: number;
  /** Where it was pressed. */
  readonly from: Point;
}

function followPointer(slider: HTMLInputElement, hold: { current: Hold }, on: Drag): () => void {
  let grip: Grip | null = null;
  let value = NaN;
  let reportedMs = -Infinity;
  let isOnThumb = false;

  function press(event: PointerEvent): void {
    if (event.button !== 0 || grip !== null) return;
    const { way, thumbPx } = layoutOf(slider);
    const isFinger = event.pointerType === 'touch';
    const reachPx = isFinger ? Math.max(FINGER_REACH_PX, thumbPx / 2) : thumbPx / 2;
    value = on.shown();
    const besidePx = gripOf(way, value, { atPx: event.clientX, reachPx, isFinger });
    hold.current = 'brushed';
    isOnThumb = besidePx !== null;
    if (besidePx === null) return;
    grip = { pointer: event.pointerId, way, besidePx, from: pointOf(event) };
    // The browser would move the value by itself.
    event.preventDefault();
    if (!isFinger) take(grip, event);
  }

  function take(taken: Grip, event: PointerEvent): void {
    hold.current = 'held';
    slider.focus({ preventScroll: true });
    moveTo(taken, event.clientX);
    slider.addEventListener('pointerrawupdate', report);
    slider.setPointerCapture(event.pointerId);
  }

  function moveTo({ way, besidePx }: Grip, clientX: number): void {
    const next = valueAt(way, clientX - besidePx);
    if (next === value) return;
    value = next;
    on.drag(next);
  }

  function report(event: Event): void {
    if (!(event instanceof PointerEvent) || event.timeStamp - reportedMs < REPORT_EACH_MS) return;
    reportedMs = event.timeStamp;
    follow(event);
  }

  function follow(event: PointerEvent): void {
    if (grip?.pointer !== event.pointerId) return;
    if (hold.current === 'held') moveTo(grip, event.clientX);
    else if (isSideways(grip.from, pointOf(event))) take(grip, event);
  }

  function end(event: PointerEvent): void {
    if (grip !== null && grip.pointer !== event.pointerId) return;
    const wasHeld = hold.current === 'held';
    grip = null;
    hold.current = 'free';
    slider.removeEventListener('pointerrawupdate', report);
    if (wasHeld) on.release();
  }

  /** A finger is captured by what it pressed, inside of the slider, and that loses it to the slider. */
  function lost(event: PointerEvent): void {
    if (!slider.hasPointerCapture(event.pointerId)) end(event);
  }

  function pressTwice(): void {
    if (isOnThumb) on.pressTwice();
  }

  const listening = new AbortController();
  const { signal } = listening;
  slider.addEventListener('pointerdown', press, { signal });
  slider.addEventListener('pointermove', follow, { signal });
  slider.addEventListener('pointerup', end, { signal });
  slider.addEventListener('pointercancel', end, { signal });
  slider.addEventListener('lostpointercapture', lost, { signal });
  slider.addEventListener('dblclick', pressTwice, { signal });
  return () => {
    slider.removeEventListener('pointerrawupdate', report);
    listening.abort();
  };
}

const pointOf = ({ clientX, clientY }: PointerEvent): Point => ({ x: clientX, y: clientY });

/** The thumb stays whole at both ends. */
function layoutOf(slider: HTMLInputElement): { readonly way: Way; readonly thumbPx: number } {
  const { left, width } = slider.getBoundingClientRect();
  const thumbPx = parseFloat(getComputedStyle(slider).getPropertyValue('--thumb'));
  const [min, max] = [Number(slider.min), Number(slider.max)];
  return { way: { fromPx: left + thumbPx / 2, lengthPx: width - thumbPx, min, max }, thumbPx };
}
