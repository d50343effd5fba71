// Dragging a slider with a pointer. Browsers delay `input` events until the next frame, up to 17 ms, and a moving native thumb causes
// layout and paint of the whole page; so the slider hides its thumb and this module reads the pointer. A finger must take the thumb
// and move sideways: scrolling past a slider never moves a servo.

import { useEffect, useEffectEvent, type RefObject, useRef } from 'react';
import type { Range } from '#shared/codec/families.ts';

/** Less than one notch of any common wheel; touch pads send many small deltas. */
const NOTCH_PX = 50;

interface WheelSteps {
  mayStep(): boolean;
  step(change: 1 | -1, isFar: boolean): void;
}

/** The wheel steps only over a focused element that may be stepped now, so that scrolling past a servo never moves it. */
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

/** The path of the thumb's middle, and the values at its ends. */
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
  /** Half the width within which the thumb reacts. */
  readonly reachPx: number;
  /** A finger may be there to scroll. */
  readonly isFinger: boolean;
}

/** The distance from the thumb's middle at which a press takes it; null for a finger beside the thumb. */
export function gripOf(way: Way, value: number, { atPx, reachPx, isFinger }: Press): number | null {
  const besidePx = atPx - placeOf(way, value);
  if (Math.abs(besidePx) <= reachPx) return besidePx;
  return isFinger ? null : 0;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** More than a resting finger moves. */
const TREMBLE_PX = 6;

/** True if a finger drags; up or down it scrolls. */
export function isSideways(from: Point, to: Point): boolean {
  const [x, y] = [Math.abs(to.x - from.x), Math.abs(to.y - from.y)];
  return x > TREMBLE_PX && x > y;
}

/** Less than the shortest packet with its gap takes: reports in between would be replaced in the queue. */
const REPORT_EACH_MS = 4;

/** Half of a touch target. */
const FINGER_REACH_PX = 22;

/** `brushed`: a finger touches the slider and has not moved the thumb. */
export type Hold = 'free' | 'held' | 'brushed';

interface Drag {
  /** The value at the thumb. */
  shown(): number;
  drag(value: number): void;
  release(): void;
  /** A finger took the thumb. */
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
  /** Distance from the thumb's middle. */
  readonly besidePx: number;
  /** Position of the press. */
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
    // Otherwise the browser would set the value.
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

  /** Touch events are captured by the pressed element within the slider; this moves the capture to the slider. */
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

/** The path ends half a thumb before both ends of the slider. */
function layoutOf(slider: HTMLInputElement): { readonly way: Way; readonly thumbPx: number } {
  const { left, width } = slider.getBoundingClientRect();
  const thumbPx = parseFloat(getComputedStyle(slider).getPropertyValue('--thumb'));
  const [min, max] = [Number(slider.min), Number(slider.max)];
  return { way: { fromPx: left + thumbPx / 2, lengthPx: width - thumbPx, min, max }, thumbPx };
}
