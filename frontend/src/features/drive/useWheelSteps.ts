// The wheel as a way to step: only over something that has the focus and may be stepped now, so that scrolling past a servo
// never moves it. Everywhere else it scrolls.

import { useEffect, useEffectEvent, type RefObject } from 'react';

/** Less than one notch of any common wheel; a touch pad sends many small parts. */
const NOTCH_PX = 50;

export interface WheelSteps {
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
