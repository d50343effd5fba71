// The two small views beside the arm: the base from above and the hand from the front. Draw what they are given.

import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import type { ArmPicture } from './pose.ts';
import figure from './figure.module.css';
import styles from './insets.module.css';

export type InsetLook = 'commanded' | 'estimated' | 'preview';

interface InsetProps {
  readonly estimated: ArmPicture;
  readonly commanded: ArmPicture;
  readonly preview: ArmPicture;
}

export function BaseView({ estimated, commanded, preview }: InsetProps) {
  return (
    <figure className={styles.inset}>
      <svg viewBox="-50 -50 100 100" role="img" aria-label={words.body.base}>
        <circle className={styles.ring} r={44} />
        <path className={styles.scale} d="M0 -44V-38M-44 0h6M44 0h-6M-31 -31l4 4M31 -31l-4 4" />
        <g data-base="commanded" transform={turn(commanded.base.degrees)}>
          <path className={cx(figure.ghost, !commanded.base.known && figure.unknown)} d={POINTER} />
        </g>
        <g data-base="estimated" transform={turn(estimated.base.degrees)}>
          <path className={cx(figure.solid, !estimated.base.known && figure.unknown)} d={POINTER} />
        </g>
        <g data-base="preview" transform={turn(preview.base.degrees)}>
          <path className={cx(figure.preview, !preview.base.known && figure.unknown)} d={POINTER} />
        </g>
        <circle className={figure.pin} r={4} />
      </svg>
      <figcaption className={styles.caption}>{words.body.base}</figcaption>
    </figure>
  );
}

export function HandView({ estimated, commanded, preview }: InsetProps) {
  return (
    <figure className={styles.inset}>
      <svg viewBox="-50 -50 100 100" role="img" aria-label={words.body.hand}>
        <circle className={styles.ring} r={44} />
        <path className={styles.scale} d="M0 -44V-38M-44 0h6M44 0h-6M-31 -31l4 4M31 -31l-4 4" />
        <Hand name="commanded" picture={commanded} look={figure.ghost} />
        <Hand name="estimated" picture={estimated} look={figure.solid} />
        <Hand name="preview" picture={preview} look={figure.preview} />
      </svg>
      <figcaption className={styles.caption}>{words.body.hand}</figcaption>
    </figure>
  );
}

interface HandProps {
  readonly name: InsetLook;
  readonly picture: ArmPicture;
  readonly look: string | undefined;
}

function Hand({ name, picture, look }: HandProps) {
  const className = cx(look, !picture.jawFront.known && figure.unknown);
  return (
    <g data-hand={name} transform={turn(picture.roll.degrees)}>
      <path className={className} d="M-7 -7h14v14h-14z" />
      <path data-finger="1" className={className} transform={spread(1, picture)} d={FINGER} />
      <path data-finger="-1" className={className} transform={spread(-1, picture)} d={FINGER} />
    </g>
  );
}

export function drawBase(frame: HTMLElement, name: InsetLook, { base }: ArmPicture): void {
  const group = frame.querySelector(`[data-base='${name}']`);
  group?.setAttribute('transform', turn(base.degrees));
  group?.firstElementChild?.classList.toggle(figure.unknown ?? '', !base.known);
}

export function drawHand(frame: HTMLElement, name: InsetLook, picture: ArmPicture): void {
  const group = frame.querySelector(`[data-hand='${name}']`);
  if (group === null) return;
  group.setAttribute('transform', turn(picture.roll.degrees));
  for (const part of group.children) part.classList.toggle(figure.unknown ?? '', !picture.jawFront.known);
  group.querySelector("[data-finger='1']")?.setAttribute('transform', spread(1, picture));
  group.querySelector("[data-finger='-1']")?.setAttribute('transform', spread(-1, picture));
}

const POINTER = 'M-7 6a7 7 0 0 0 14 0V-26l-4 -4v-6h-6v6l-4 4z';
const FINGER = 'M0 -8h9v16h-9z';

const turn = (degrees: number): string => `rotate(${degrees.toFixed(2)})`;

/** From the front the jaws slide apart. */
const spread = (side: 1 | -1, { jawFront }: ArmPicture): string =>
  `scale(${side} 1) translate(${(8 + jawFront.degrees * 0.5).toFixed(2)} 0)`;
