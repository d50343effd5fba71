// The arm from the side as nested joints, each a group that turns. One drawing for the live body, its ghost and the small
// picture of a frame. Joints without a known position are dashed. Draws what it is given; knows no session.

import { cx } from '../../ui/cx.ts';
import type { ArmPicture } from './pose.ts';
import styles from './figure.module.css';

/** Lengths in the drawing's units, in the proportions of the common arm. */
export const UPPER = 92;
export const FORE = 84;

/** `ghost`: where it was asked to be; `preview`: where a group would have it. Both are outlines. */
export type FigureLook = 'solid' | 'ghost' | 'preview' | 'small';

export const isOutline = (look: FigureLook): boolean => look === 'ghost' || look === 'preview';

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

/** Sets the same picture on a drawn figure, without React: for each animation frame. */
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
