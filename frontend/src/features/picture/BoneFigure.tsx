// A body by bones, one drawing for the live picture, its ghost and the small picture of a frame, and the same set on a drawn
// one past React. Draws what it is given.

import { cx } from '../../ui/cx.ts';
import { isOutline, type FigureLook } from './ArmFigure.tsx';
import type { BonePicture, Point } from './bones.ts';
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
          d={capsule(from, to)}
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
    paths[index]?.setAttribute('d', capsule(from, to));
    paths[index]?.classList.toggle(styles.unknown ?? '', !known);
  }
}

const corners = (points: readonly Point[]): string =>
  points.map(({ x, y }) => `${x.toFixed(2)},${y.toFixed(2)}`).join(' ');

/** Two round ends with straight flanks. */
function capsule(from: Point, to: Point): string {
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const [sideX, sideY] = [(-(to.y - from.y) / length) * RADIUS, ((to.x - from.x) / length) * RADIUS];
  const at = (point: Point, side: 1 | -1): string =>
    `${(point.x + sideX * side).toFixed(2)} ${(point.y + sideY * side).toFixed(2)}`;
  const round = (point: Point, side: 1 | -1): string => `A${RADIUS} ${RADIUS} 0 0 0 ${at(point, side)}`;
  return `M${at(from, -1)}${round(from, 1)}L${at(to, 1)}${round(to, -1)}Z`;
}
