// Draws a slider's marks on a canvas from plain numbers.

import type { Pen, Look } from '../picture/Canvas.tsx';

export interface Thumb {
  readonly width: number;
  readonly height: number;
}

/** In fractions of the track. */
export interface Marks {
  readonly target: number;
  readonly estimate: number | null;
  readonly isHeld: boolean;
  readonly isKnown: boolean;
  readonly isBlocked: boolean;
}

const BORDER = 2;
const CORNER = 4;
const BAR = { width: 3, height: 9, corner: 1 };
/** The bar begins within the thumb, so that there is no gap. */
const OVERLAP = 2;
const DASH = [4, 3];

export function thumbOf(element: Element): Thumb {
  const style = getComputedStyle(element);
  const lengthOf = (name: string): number => parseFloat(style.getPropertyValue(name));
  return { width: lengthOf('--thumb'), height: lengthOf('--thumb-height') };
}

export function paintMarks({ ctx, look, size }: Pen, thumb: Thumb, marks: Marks): void {
  const [way, middle] = [size.width - thumb.width, size.height / 2];
  if (marks.estimate !== null) {
    const left = thumb.width / 2 + marks.estimate * way - BAR.width / 2;
    ctx.fillStyle = look.estimated;
    ctx.beginPath();
    ctx.roundRect(left, middle + thumb.height / 2 - OVERLAP, BAR.width, BAR.height, BAR.corner);
    ctx.fill();
  }
  // Whole pixels have sharp edges.
  const left = Math.round(marks.target * way * devicePixelRatio) / devicePixelRatio;
  ctx.lineWidth = BORDER;
  ctx.strokeStyle = marks.isKnown ? look.commanded : look.unknown;
  ctx.setLineDash(marks.isKnown ? [] : DASH);
  ctx.beginPath();
  ctx.roundRect(
    left + BORDER / 2,
    middle - thumb.height / 2 + BORDER / 2,
    thumb.width - BORDER,
    thumb.height - BORDER,
    CORNER - BORDER / 2,
  );
  const ground = groundOf(look, marks);
  if (ground !== null) {
    ctx.fillStyle = ground;
    ctx.fill();
  }
  ctx.stroke();
}

function groundOf(look: Look, { isHeld, isBlocked }: Marks): string | null {
  if (isBlocked) return null;
  return isHeld ? look.commanded : look.raised;
}
