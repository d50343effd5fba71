// Which value a native slider takes under a pointer, as the browser will compute it with its next frame.

/** The thumb's middle follows the pointer; it stays whole at both ends. */
export function valueUnder(slider: HTMLInputElement, clientX: number): number {
  const { left, width } = slider.getBoundingClientRect();
  const thumbPx = parseFloat(getComputedStyle(slider).getPropertyValue('--thumb'));
  return valueAt({
    ...{ fromPx: left + thumbPx / 2, lengthPx: width - thumbPx },
    ...{ min: Number(slider.min), max: Number(slider.max), atPx: clientX },
  });
}

export interface Way {
  readonly fromPx: number;
  readonly lengthPx: number;
  readonly min: number;
  readonly max: number;
  readonly atPx: number;
}

export function valueAt({ fromPx, lengthPx, min, max, atPx }: Way): number {
  const share = Math.min(1, Math.max(0, (atPx - fromPx) / lengthPx));
  return min + Math.round(share * (max - min));
}
