// The pointer on the tracks, whatever it is: one press at a time becomes a gesture, two fingers zoom and pan, a finger that rests opens the
// menu or, dragged on, draws a box; the middle button pans. Escape, a lost pointer and a lost window call a gesture off. Knows no edits.

import type { Gesture, Held, Press, StatusName } from './gesture.ts';
import { boxFrom, gestureOf, panFrom } from './gestures.ts';
import { topOfRows, type Spot } from './rows.ts';

// Tracks that scroll below what is dragged past one of their ends, the faster the farther: through time, and some
// through the rows too.

interface EdgePanHost {
  widthPx(): number;
  /** Where the rows that scroll begin and end. */
  rowsPx(): { readonly top: number; readonly bottom: number };
  pan(byPx: number): void;
  scroll(byPx: number): void;
  /** They have gone on: what is dragged is elsewhere in time. */
  panned(): void;
}

interface EdgePan {
  /** Where on the tracks something is dragged. */
  at(spot: Spot, throughRows: boolean): void;
  end(): void;
}

const LEAST_PX = 2;
const MOST_PX = 24;
const PX_OVER_A_STEP = 6;

/** How far the tracks scroll in each frame of the screen; 0 while `x` is on them. */
export function edgeStep(x: number, widthPx: number): number {
  const overPx = x < 0 ? x : Math.max(0, x - widthPx);
  return Math.sign(overPx) * Math.min(MOST_PX, LEAST_PX + Math.abs(overPx) / PX_OVER_A_STEP);
}

function createEdgePan(host: EdgePanHost): EdgePan {
  let request = 0;
  let latest: { readonly spot: Spot; readonly throughRows: boolean } = {
    spot: { x: 0, y: 0 },
    throughRows: false,
  };

  function steps() {
    const { spot, throughRows } = latest;
    const { top, bottom } = host.rowsPx();
    return {
      byPx: edgeStep(spot.x, host.widthPx()),
      rowsPx: throughRows ? edgeStep(spot.y - top, bottom - top) : 0,
    };
  }

  function step(): void {
    request = 0;
    const { byPx, rowsPx } = steps();
    if (byPx === 0 && rowsPx === 0) return;
    if (byPx !== 0) host.pan(byPx);
    if (rowsPx !== 0) host.scroll(rowsPx);
    host.panned();
    request = requestAnimationFrame(step);
  }

  return {
    at(spot, throughRows) {
      latest = { spot, throughRows };
      const { byPx, rowsPx } = steps();
      if (request === 0 && (byPx !== 0 || rowsPx !== 0)) request = requestAnimationFrame(step);
    },
    end() {
      cancelAnimationFrame(request);
      request = 0;
    },
  };
}

interface PointerHost {
  /** What a press begins with; `isTouch` distinguishes fingers from mice and pens. */
  press(spot: Spot, held: Held, isTouch: boolean): Press;
  pinch(before: readonly [Spot, Spot], now: readonly [Spot, Spot]): void;
  /** Through time. */
  pan(byPx: number): void;
  openMenu(spot: Spot): void;
  doubleClick(spot: Spot): void;
  /** A mouse is over the tracks and presses nothing; null: no longer. */
  hover(spot: Spot | null): void;
  /** `describe`: the current place of the dragged item. */
  say(status: StatusName | null, describe?: () => string): void;
}

/** Less is a click. */
const CLICK_PX = 4;
const REST_MS = 500;

export function followPointer(tracks: HTMLElement, host: PointerHost): () => void {
  const fingers = new Map<number, Spot>();
  let gesture: Gesture | null = null;
  let press: Press | null = null;
  let again = (): void => undefined;
  let hasMoved = false;
  let rest: ReturnType<typeof setTimeout> | undefined;
  let hasRested = false;
  const edge = createEdgePan({
    widthPx: () => tracks.clientWidth,
    rowsPx: () => ({ top: press === null ? 0 : topOfRows(press.sizes), bottom: tracks.clientHeight }),
    pan: host.pan,
    scroll: (byPx) => press?.scroll(byPx),
    panned: () => again(),
  });
  const listening = new AbortController();
  const { signal } = listening;

  const spotOf = ({ clientX, clientY }: MouseEvent): Spot => {
    const { left, top } = tracks.getBoundingClientRect();
    return { x: clientX - left, y: clientY - top };
  };
  const heldOf = ({ ctrlKey, metaKey, shiftKey, altKey }: MouseEvent): Held => ({
    ...{ ctrl: ctrlKey || metaKey, shift: shiftKey, alt: altKey },
  });

  function finish(done: (gesture: Gesture) => void): void {
    clearTimeout(rest);
    edge.end();
    const ended = gesture;
    gesture = null;
    press = null;
    if (ended === null) return;
    done(ended);
    host.say(null);
  }
  const callOff = (): void => finish((ended) => ended.cancel());

  function down(event: PointerEvent): void {
    const isPan = event.button === 1;
    if ((event.button !== 0 && !isPan) || !(event.target instanceof HTMLCanvasElement)) return;
    const isTouch = event.pointerType === 'touch';
    tracks.setPointerCapture(event.pointerId);
    if (isTouch) fingers.set(event.pointerId, spotOf(event));
    if (fingers.size > 1) return callOff();
    hasMoved = false;
    hasRested = false;
    press = host.press(spotOf(event), heldOf(event), isTouch);
    gesture = isPan ? panFrom(press) : gestureOf(press);
    host.say(gesture.status, gesture.describe);
    if (isTouch) rest = setTimeout(rested, REST_MS);
  }

  function rested(): void {
    hasRested = true;
    host.say('rested');
  }

  function move(event: PointerEvent): void {
    const spot = spotOf(event);
    if (fingers.size > 1) return pinch(event.pointerId, spot);
    fingers.forEach((_, id) => id === event.pointerId && fingers.set(id, spot));
    if (gesture === null || press === null) {
      if (event.pointerType === 'mouse') host.hover(spot);
      return;
    }
    if (!hasMoved && Math.hypot(spot.x - press.spot.x, spot.y - press.spot.y) < CLICK_PX) return;
    if (!hasMoved && hasRested) draw(press);
    hasMoved = true;
    clearTimeout(rest);
    const held = heldOf(event);
    again = () => gesture?.move(spot, held);
    again();
    if (gesture.leadsOn !== undefined) edge.at(spot, gesture.leadsOn === 'throughRowsToo');
  }

  function draw(from: Press): void {
    gesture?.cancel();
    gesture = boxFrom(from);
    host.say(gesture.status, gesture.describe);
  }

  function pinch(id: number, spot: Spot): void {
    if (!fingers.has(id)) return;
    const before = [...fingers.values()];
    fingers.set(id, spot);
    const now = [...fingers.values()];
    const [one, other, oneNow, otherNow] = [before[0], before[1], now[0], now[1]];
    if (one && other && oneNow && otherNow) host.pinch([one, other], [oneNow, otherNow]);
  }

  function up(event: PointerEvent): void {
    fingers.delete(event.pointerId);
    const isMenu = hasRested && !hasMoved && gesture !== null;
    finish((ended) => ended.end(!hasMoved && !isMenu));
    if (isMenu) host.openMenu(spotOf(event));
  }

  function lost(event: PointerEvent): void {
    fingers.delete(event.pointerId);
    callOff();
  }

  tracks.addEventListener('pointerdown', down, { signal });
  tracks.addEventListener('pointermove', move, { signal });
  tracks.addEventListener('pointerup', up, { signal });
  tracks.addEventListener('pointercancel', lost, { signal });
  tracks.addEventListener('pointerleave', () => host.hover(null), { signal });
  tracks.addEventListener('dblclick', (event) => host.doubleClick(spotOf(event)), { signal });
  tracks.addEventListener(
    'contextmenu',
    (event) => {
      event.preventDefault();
      // The other button amid a drag.
      if (gesture !== null && hasMoved) {
        callOff();
        return;
      }
      // A finger that rests also requests a menu here; it gets ours when it is lifted.
      if (!(event instanceof PointerEvent && event.pointerType === 'touch')) host.openMenu(spotOf(event));
    },
    { signal },
  );
  window.addEventListener('blur', callOff, { signal });
  window.addEventListener('keydown', ({ key }) => key === 'Escape' && callOff(), { signal, capture: true });
  return () => {
    callOff();
    listening.abort();
  };
}
