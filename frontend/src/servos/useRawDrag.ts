// A slider's value at each report of the pointer that drags it. Browsers keep `input` back until the next frame, which
// makes it up to 17 ms old when the wire is free for it. Where raw reports are missing, `input` alone has to do.

import { useEffect, useEffectEvent, type RefObject } from 'react';
import { valueUnder } from './sliderValue.ts';

/** Below the shortest packet with its gap: reports in between would be overtaken before they leave. */
const REPORT_EACH_MS = 4;

export function useRawDrag(input: RefObject<HTMLInputElement | null>, drag: (value: number) => void): void {
  const dragNow = useEffectEvent(drag);
  useEffect(() => {
    const slider = input.current;
    if (slider === null) return;
    let reportedMs = -Infinity;
    function report(event: Event): void {
      if (slider === null || !(event instanceof PointerEvent)) return;
      if (event.timeStamp - reportedMs < REPORT_EACH_MS) return;
      reportedMs = event.timeStamp;
      dragNow(valueUnder(slider, event.clientX));
    }
    let isDown = false;
    function press(): void {
      isDown = true;
    }
    // Only once the browser itself has begun to drag: a swipe that scrolls past never does.
    function begin(): void {
      if (isDown) slider?.addEventListener('pointerrawupdate', report);
    }
    function end(): void {
      isDown = false;
      slider?.removeEventListener('pointerrawupdate', report);
    }
    const listeners = {
      pointerdown: press,
      input: begin,
      pointerup: end,
      pointercancel: end,
      lostpointercapture: end,
    };
    for (const [name, hear] of Object.entries(listeners)) slider.addEventListener(name, hear);
    return () => {
      end();
      for (const [name, hear] of Object.entries(listeners)) slider.removeEventListener(name, hear);
    };
  }, [input]);
}
