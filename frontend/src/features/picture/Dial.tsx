// A dial that shows a servo's horn: the needle is the estimate, the hollow triangle on the rim the target. An unknown position is a
// hatched face with a question mark. The needles of all dials on a canvas are one path per kind: few strokes for many dials.

import { useState } from 'react';
import type { Family } from '#shared/codec/families.ts';
import { useStores } from '../stores.ts';
import { READABLE_MS, useFollow } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/words.ts';
import { Drawing } from './SharedSheet.tsx';
import { motionInFrame } from './motion.ts';
import { dialDegrees, halfDegree } from './pose.ts';
import overlay from './overlay.module.css';
import styles from './Dial.module.css';
import type { Look } from './Canvas.tsx';

export function Dial({ servo, family }: { readonly servo: number; readonly family: Family }) {
  const { device } = useStores();
  const turn = (position: number | null): number | null =>
    position === null ? null : halfDegree(dialDegrees(position, family));
  return (
    <span className={styles.place}>
      <DialFace servo={servo} />
      <Drawing
        className={overlay.over}
        shown={() => {
          const { target, estimated } = motionInFrame(device, servo);
          return [turn(target), turn(estimated)] as const;
        }}
        paint={({ ctx, look, size }, [target, needle]) => {
          const spot = { x: size.width / 2, y: size.height / 2 };
          paintNeedles(ctx, look, size.width, [{ spot, needles: { target, needle, preview: null } }]);
        }}
      />
    </span>
  );
}

/** The dial without needles, where the needles of several dials are drawn together. */
export function DialFace({ servo }: { readonly servo: number }) {
  const isKnown = useIsKnown(servo);
  return (
    <svg
      className={styles.dial}
      viewBox="-24 -24 48 48"
      role="img"
      aria-label={words.body.gaugeFigure({ servo })}
    >
      <path className={styles.rim} d={RIM} />
      {isKnown ? <circle className={styles.hub} r={4} /> : <Unknown />}
    </svg>
  );
}

function useIsKnown(servo: number): boolean {
  const { device } = useStores();
  const isKnownNow = (): boolean => motionInFrame(device, servo).estimated !== null;
  const [isKnown, setKnown] = useState(isKnownNow);
  useFollow({ read: isKnownNow, draw: setKnown, eachMs: READABLE_MS });
  return isKnown;
}

function Unknown() {
  return (
    <>
      <path className={styles.hatch} d="M-9 5L5 -9M-6 9L9 -6M-11 0L0 -11M0 11L11 0" />
      <text className={styles.question} y={5}>
        {words.servos.unknown}
      </text>
    </>
  );
}

/** 240 degrees of a circle of radius 19, open below. */
const RIM = 'M-16.45 9.5A19 19 0 1 1 16.45 9.5';

/** Units across a dial's drawing. */
const FACE = 48;

type Corners = readonly (readonly [x: number, y: number])[];
/** Hollow: filling the inside again costs a third of stroking the outline. */
const TARGET: Corners = [
  [-5.2, -23.25],
  [5.2, -23.25],
  [0, -14.1],
];
const WITHIN_TARGET: Corners = [
  [-2.8, -21.75],
  [2.8, -21.75],
  [0, -16.9],
];
/** Begins within the ring of the hub, which is part of the face. */
const NEEDLE: Corners = [
  [-1.8, -4],
  [-1, -14],
  [1, -14],
  [1.8, -4],
];
const PREVIEW: Corners = [
  [0, -6],
  [0, -19],
];

/** In degrees from straight up; null for a needle that is not drawn. */
interface Needles {
  readonly target: number | null;
  readonly needle: number | null;
  readonly preview: number | null;
}

/** The middle of a dial. */
export interface Spot {
  readonly x: number;
  readonly y: number;
}

export interface NeedlesAt {
  readonly spot: Spot;
  readonly needles: Needles;
}

/** Paints needles on dials of one size. */
export function paintNeedles(
  ctx: CanvasRenderingContext2D,
  look: Look,
  diameter: number,
  dials: readonly NeedlesAt[],
): void {
  const scale = diameter / FACE;
  if (outline(ctx, scale, dials, 'target', TARGET)) fill(ctx, look.commanded);
  if (outline(ctx, scale, dials, 'target', WITHIN_TARGET)) fill(ctx, look.panel);
  if (outline(ctx, scale, dials, 'needle', NEEDLE)) fill(ctx, look.estimated);
  if (outline(ctx, scale, dials, 'preview', PREVIEW)) {
    ctx.setLineDash([2 * scale, 2 * scale]);
    stroke(ctx, look.ink, 2 * scale);
    ctx.setLineDash([]);
  }
}

/** Adds one kind of needle on all dials to the path; false if no dial has it. */
function outline(
  ctx: CanvasRenderingContext2D,
  scale: number,
  dials: readonly NeedlesAt[],
  which: keyof Needles,
  corners: Corners,
): boolean {
  let isAny = false;
  ctx.beginPath();
  for (const { spot, needles } of dials) {
    const degrees = needles[which];
    if (degrees === null) continue;
    isAny = true;
    turned(ctx, spot, scale, degrees, corners);
  }
  return isAny;
}

function turned(
  ctx: CanvasRenderingContext2D,
  { x, y }: Spot,
  scale: number,
  degrees: number,
  corners: Corners,
): void {
  const radians = (degrees * Math.PI) / 180;
  const [sin, cos] = [scale * Math.sin(radians), scale * Math.cos(radians)];
  for (const [index, [right, down]] of corners.entries()) {
    const [atX, atY] = [x + right * cos - down * sin, y + right * sin + down * cos];
    if (index === 0) ctx.moveTo(atX, atY);
    else ctx.lineTo(atX, atY);
  }
  if (corners.length > 2) ctx.closePath();
}

function fill(ctx: CanvasRenderingContext2D, colour: string): void {
  ctx.fillStyle = colour;
  ctx.fill();
}

function stroke(ctx: CanvasRenderingContext2D, colour: string, width: number): void {
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.stroke();
}
