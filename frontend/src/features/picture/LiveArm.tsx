// The live pictures of a robot: the six-servo arm with its base from above and its hand from the front, and bodies by bones. Solid is
// the estimate, the outline the target, the dotted outline a preview of the open group.

import { useRef } from 'react';
import type { ServoMotion, Motions } from '#shared/robot/state.ts';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import { type ArmPicture, armPicture, JOINT, samePicture, type Pose } from './pose.ts';
import { useDevice, usePlayback, useStores, useRobot } from '../stores.ts';
import { ArmFigure, drawArm, BoneFigure, drawBones } from './ArmFigure.tsx';
import { motionsInFrame, usePreview } from './motion.ts';
import { useMotions } from './useMotions.ts';
import figure from './figure.module.css';
import styles from './LiveArm.module.css';
import type { Robot } from '#shared/profile/robot.ts';
import { bonesOf, type BonePicture } from './bones.ts';
import { reachOf, viewBoxOf } from './reach.ts';

type InsetLook = 'commanded' | 'estimated' | 'preview';

interface InsetProps {
  readonly estimated: ArmPicture;
  readonly commanded: ArmPicture;
  readonly preview: ArmPicture;
}

function BaseView({ estimated, commanded, preview }: InsetProps) {
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

function HandView({ estimated, commanded, preview }: InsetProps) {
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

function drawBase(frame: HTMLElement, name: InsetLook, { base }: ArmPicture): void {
  const group = frame.querySelector(`[data-base='${name}']`);
  group?.setAttribute('transform', turn(base.degrees));
  group?.firstElementChild?.classList.toggle(figure.unknown ?? '', !base.known);
}

function drawHand(frame: HTMLElement, name: InsetLook, picture: ArmPicture): void {
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

/** Seen from the front, the jaws slide apart. */
const spread = (side: 1 | -1, { jawFront }: ArmPicture): string =>
  `scale(${side} 1) translate(${(8 + jawFront.degrees * 0.5).toFixed(2)} 0)`;

const ARM_SERVOS = Object.values(JOINT);

export function LiveArm() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const frame = useRef<HTMLDivElement>(null);
  const pictureOf = (value: (motion: ServoMotion) => number | null): ArmPicture => {
    const motion = motionsInFrame(device);
    const pose: Pose = (servo) => value(motion(servo));
    return armPicture(pose, family);
  };
  const estimated = (): ArmPicture => pictureOf((motion) => motion.estimated);
  const commanded = (): ArmPicture => pictureOf((motion) => motion.target);
  const nowhere = armPicture(() => null, family);
  const isPreviewing = usePlayback(({ phase }) => phase === 'previewing');
  useMotions(ARM_SERVOS, () => {
    if (frame.current !== null) draw(frame.current, estimated(), commanded());
  });

  usePreview((pose) => {
    if (frame.current !== null)
      drawViews(frame.current, 'preview', pose === null ? nowhere : armPicture(pose, family));
  });

  return (
    <div className={styles.views} ref={frame} data-previewing={isPreviewing}>
      <svg className={styles.side} viewBox="-250 -266 500 318" role="img" aria-label={words.body.figure}>
        <Floor />
        <g data-figure="estimated">
          <ArmFigure picture={estimated()} look="solid" />
        </g>
        <g data-figure="commanded">
          <ArmFigure picture={commanded()} look="ghost" />
        </g>
        <g data-figure="preview">
          <ArmFigure picture={nowhere} look="preview" />
        </g>
      </svg>
      <div className={styles.insets}>
        <BaseView estimated={estimated()} commanded={commanded()} preview={nowhere} />
        <HandView estimated={estimated()} commanded={commanded()} preview={nowhere} />
      </div>
    </div>
  );
}

function draw(frame: HTMLElement, estimated: ArmPicture, commanded: ArmPicture): void {
  drawViews(frame, 'estimated', estimated);
  drawViews(frame, 'commanded', commanded);
  const outline = frame.querySelector("[data-figure='commanded']");
  outline?.setAttribute('visibility', samePicture(estimated, commanded) ? 'hidden' : 'visible');
}

function drawViews(frame: HTMLElement, name: InsetLook, picture: ArmPicture): void {
  const figure = frame.querySelector(`[data-figure='${name}']`);
  if (figure instanceof SVGGElement) drawArm(figure, picture);
  drawBase(frame, name, picture);
  drawHand(frame, name, picture);
}

/** The ground, the reach of the arm and its foot. */
function Floor() {
  return (
    <g aria-hidden="true">
      {[92, 176, 246].map((radius) => (
        <path
          key={radius}
          className={styles.reach}
          d={`M${-radius} 0A${radius} ${radius} 0 0 1 ${radius} 0`}
        />
      ))}
      <path className={styles.reach} d="M0 0V-246" />
      <path className={styles.ground} d="M-250 44H250" />
      <path className={styles.foot} d="M-40 44l6-16h68l6 16z" />
      <path className={styles.foot} d="M-20 28v-28a20 20 0 0 1 40 0v28z" />
    </g>
  );
}

const SHOWN = ['estimated', 'target'] as const;
/** In board units: smaller differences are invisible in the picture. */
const SAME = 6;

export function LiveBones({ className }: { readonly className?: string | undefined }) {
  const { device } = useStores();
  const robot = useRobot();
  const picture = useRef<SVGSVGElement>(null);
  const now = (which: (typeof SHOWN)[number]): BonePicture | null => {
    const motion = motionsInFrame(device);
    return bonesOf(robot, (servo) => motion(servo)[which]);
  };
  useMotions(
    robot.servos.map(({ servo }) => servo),
    () => {
      for (const which of SHOWN) {
        const figure = picture.current?.querySelector<SVGGElement>(`[data-figure='${which}']`);
        const bones = now(which);
        if (figure instanceof SVGGElement && bones !== null) drawBones(figure, bones);
        if (which === 'target')
          figure?.setAttribute('visibility', ghostVisibility(robot, motionsInFrame(device)));
      }
    },
  );
  const isPreviewing = usePlayback(({ phase }) => phase === 'previewing');
  usePreview((pose) => {
    const figure = picture.current?.querySelector<SVGGElement>("[data-figure='preview']");
    const bones = pose === null ? null : bonesOf(robot, pose);
    figure?.setAttribute('visibility', bones === null ? 'hidden' : 'visible');
    if (bones !== null && figure instanceof SVGGElement) drawBones(figure, bones);
  });
  const [estimated, target, reach] = [now('estimated'), now('target'), reachOf(robot)];
  if (estimated === null || target === null || reach === null) return null;
  return (
    <svg
      ref={picture}
      className={cx(styles.picture, className)}
      viewBox={viewBoxOf(reach)}
      role="img"
      aria-label={words.servoPanel.figure({ robot: robot.name })}
      data-previewing={isPreviewing}
    >
      <g data-figure="estimated">
        <BoneFigure picture={estimated} look="solid" />
      </g>
      <g data-figure="target" visibility={ghostVisibility(robot, motionsInFrame(device))}>
        <BoneFigure picture={target} look="ghost" />
      </g>
      <g data-figure="preview" visibility="hidden">
        <BoneFigure picture={target} look="preview" />
      </g>
    </svg>
  );
}

/** Hides the outline while the estimate equals the target. */
function ghostVisibility({ servos }: Robot, motion: Motions): 'visible' | 'hidden' {
  const isThere = servos.every(({ servo }) => {
    const { target, estimated } = motion(servo);
    return target === null || (estimated !== null && Math.abs(target - estimated) < SAME);
  });
  return isThere ? 'hidden' : 'visible';
}
