// Drawings of a body as an arm or by bones: for the live picture, its ghost and thumbnails. Joints with an unknown position are dashed.
// Plain values in; knows no session.

import { cx } from '../../ui/cx.ts';
import type { BonePicture, Point } from './bones.ts';
import type { ArmPicture } from './pose.ts';
import styles from './figure.module.css';

const RADIUS = 2.4;
const PARTS = ['shadow', 'trunk'] as const;

export function BoneFigure({ picture, look }: { readonly picture: BonePicture; readonly look: FigureLook }) {
  return (
    <g>
      {PARTS.map((part) => (
        <polygon
          key={part}
          data-part={part}
          className={cx(styles[part], isOutline(look) && styles.outlined)}
          points={corners(picture[part])}
        />
      ))}
      {picture.bones.map(({ servo, from, to, known }) => (
        <path
          key={servo}
          data-bone={servo}
          className={cx(styles.link, styles[look], !known && styles.unknown)}
          d={boneFigureCapsule(from, to)}
        />
      ))}
    </g>
  );
}

export function drawBones(figure: SVGGElement, picture: BonePicture): void {
  const { bones } = picture;
  for (const part of PARTS)
    figure.querySelector(`[data-part='${part}']`)?.setAttribute('points', corners(picture[part]));
  const paths = figure.querySelectorAll('[data-bone]');
  for (const [index, { from, to, known }] of bones.entries()) {
    paths[index]?.setAttribute('d', boneFigureCapsule(from, to));
    paths[index]?.classList.toggle(styles.unknown ?? '', !known);
  }
}

const corners = (points: readonly Point[]): string =>
  points.map(({ x, y }) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' ');

/** Two round ends with straight flanks. */
function boneFigureCapsule(from: Point, to: Point): string {
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const [sideX, sideY] = [(-(to.y - from.y) / length) * RADIUS, ((to.x - from.x) / length) * RADIUS];
  const at = (point: Point, side: 1 | -1): string =>
    `${(point.x + sideX * side).toFixed(2)} ${(point.y + sideY * side).toFixed(2)}`;
  const round = (point: Point, side: 1 | -1): string => `A${RADIUS} ${RADIUS} 0 0 0 ${at(point, side)}`;
  return `M${at(from, -1)}${round(from, 1)}L${at(to, 1)}${round(to, -1)}Z`;
}

/** Lengths in the drawing's units, in the proportions of the common arm. */
const UPPER = 92;
const FORE = 84;

/** `ghost`: the target; `preview`: a pose of the group. Both are outlines. */
type FigureLook = 'solid' | 'ghost' | 'preview' | 'small';

const isOutline = (look: FigureLook): boolean => look === 'ghost' || look === 'preview';

export function ArmFigure({ picture, look }: { readonly picture: ArmPicture; readonly look: FigureLook }) {
  const linkClass = (known: boolean) => cx(styles.link, styles[look], !known && styles.unknown);
  return (
    <g data-joint="shoulder" transform={turn(picture.shoulder.degrees)}>
      <path data-link="shoulder" className={linkClass(picture.shoulder.known)} d={capsule(UPPER, 17, 13)} />
      <g transform={`translate(0 ${-UPPER})`}>
        <g data-joint="elbow" transform={turn(picture.elbow.degrees)}>
          <path data-link="elbow" className={linkClass(picture.elbow.known)} d={capsule(FORE, 13, 10)} />
          <g transform={`translate(0 ${-FORE})`}>
            <g data-joint="wrist" transform={turn(picture.wrist.degrees)}>
              <path data-link="wrist" className={linkClass(picture.wrist.known)} d={PALM} />
              <g transform="translate(0 -34)">
                <Jaw side={1} degrees={picture.jaw.degrees} className={linkClass(picture.jaw.known)} />
                <Jaw side={-1} degrees={picture.jaw.degrees} className={linkClass(picture.jaw.known)} />
              </g>
            </g>
            {!isOutline(look) && <circle className={styles.pin} r={3.5} />}
          </g>
          {!isOutline(look) && <circle className={styles.pin} r={4.5} />}
        </g>
      </g>
      {!isOutline(look) && <circle className={styles.pin} r={6} />}
    </g>
  );
}

/** Updates a drawn figure without React, in each animation frame. */
export function drawArm(figure: SVGGElement, picture: ArmPicture): void {
  for (const name of ['shoulder', 'elbow', 'wrist'] as const) {
    const { degrees, known } = picture[name];
    figure.querySelector(`[data-joint='${name}']`)?.setAttribute('transform', turn(degrees));
    figure.querySelector(`[data-link='${name}']`)?.classList.toggle(styles.unknown ?? '', !known);
  }
  for (const jaw of figure.querySelectorAll('[data-jaw]')) {
    const side = jaw.getAttribute('data-jaw') === '1' ? 1 : -1;
    jaw.setAttribute('transform', jawTransform(side, picture.jaw.degrees));
    jaw.classList.toggle(styles.unknown ?? '', !picture.jaw.known);
  }
}

function Jaw({ side, degrees, className }: { side: 1 | -1; degrees: number; className: string }) {
  return <path data-jaw={side} className={className} transform={jawTransform(side, degrees)} d={JAW} />;
}

const PALM = 'M-10 0a10 10 0 0 1 20 0v-22l4-4v-12h-28v12l4 4z';
const JAW = 'M-4 4l-1-14 5-14 1-22 6 0 2 24-4 12 1 14z';

const turn = (degrees: number): string => `rotate(${degrees.toFixed(2)})`;

const jawTransform = (side: 1 | -1, degrees: number): string =>
  `scale(${side} 1) translate(6 0) rotate(${degrees.toFixed(2)})`;

/** A link from the origin upwards: two round ends of different size with straight flanks. */
function capsule(length: number, fromRadius: number, toRadius: number): string {
  return [
    `M${-fromRadius} 0`,
    `A${fromRadius} ${fromRadius} 0 0 0 ${fromRadius} 0`,
    `L${toRadius} ${-length}`,
    `A${toRadius} ${toRadius} 0 0 0 ${-toRadius} ${-length}`,
    'Z',
  ].join('');
}
