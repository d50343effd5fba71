// Places on the body, in whole percent of the picture's width and height. Pure.

export interface PlaceAt {
  readonly x: number;
  readonly y: number;
}

interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

const KEYS: Readonly<Record<string, readonly [x: number, y: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
const SHIFT_STEP = 5;

export function placeUnder(
  pointer: { readonly clientX: number; readonly clientY: number },
  box: Box,
): PlaceAt {
  return {
    x: percent((pointer.clientX - box.left) / box.width),
    y: percent((pointer.clientY - box.top) / box.height),
  };
}

/** Where an arrow key pushes it, with Shift further; null for other keys. */
export function placeBy(
  key: { readonly key: string; readonly shiftKey: boolean },
  { x, y }: PlaceAt,
): PlaceAt | null {
  const direction = KEYS[key.key];
  if (direction === undefined) return null;
  const step = key.shiftKey ? SHIFT_STEP : 1;
  return { x: percent((x + direction[0] * step) / 100), y: percent((y + direction[1] * step) / 100) };
}

/** How far apart the two nearest places are, in percent. */
export function nearest(places: readonly PlaceAt[]): number {
  const gaps = places.flatMap((one, index) =>
    places.slice(index + 1).map((other) => Math.hypot(one.x - other.x, one.y - other.y)),
  );
  return Math.min(100, ...gaps);
}

const percent = (share: number): number => Math.round(Math.min(1, Math.max(0, share)) * 100);
