// The wheel over the lanes: it zooms where the pointer is, with Shift it goes through time, and a touch pad's two fingers pan.

export interface WheelHost {
  zoom(x: number, factor: number): void;
  pan(byPx: number): void;
  scroll(byPx: number): void;
}

/** Mice turn in notches of about a hundred pixels; touch pads send less at a time, or sideways too. */
const NOTCH_PX = 50;
const ZOOM_PER_PX = 0.002;

export function followWheel(lanes: HTMLElement, host: WheelHost): () => void {
  function turn(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : NOTCH_PX / 2;
    const [x, y] = [event.deltaX * unit, event.deltaY * unit];
    const isPad = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL && (x !== 0 || Math.abs(y) < NOTCH_PX);
    if (event.shiftKey) host.pan(x + y);
    else if (isPad && !event.ctrlKey) {
      host.pan(x);
      host.scroll(y);
    } else
      host.zoom(
        event.clientX - lanes.getBoundingClientRect().left,
        Math.exp(y * (isPad ? 5 : 1) * ZOOM_PER_PX),
      );
  }
  lanes.addEventListener('wheel', turn, { passive: false });
  return () => lanes.removeEventListener('wheel', turn);
}
