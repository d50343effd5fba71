// Where a thing that is dragged in time comes to rest: at something near, else on the board's own raster. Pure.

export interface SnapField {
  /** Frame ends, other keys, playhead, markers. */
  readonly placesMs: readonly number[];
  /** The raster of the board; what is between its steps would be rounded there anyway. */
  readonly tickMs: number;
  /** How near is near. */
  readonly reachMs: number;
}

/** null: nothing holds it, each millisecond may be meant. */
export function snapped(atMs: number, field: SnapField | null): number {
  if (field === null) return Math.round(atMs);
  const { placesMs, tickMs, reachMs } = field;
  let nearest = Math.round(atMs / tickMs) * tickMs;
  let distance = reachMs;
  for (const placeMs of placesMs) {
    if (Math.abs(placeMs - atMs) > distance) continue;
    nearest = placeMs;
    distance = Math.abs(placeMs - atMs);
  }
  return nearest;
}
