// The six-servo arm from the side, its base from above and its hand from the front, as the session's motion goes. Solid is
// where it is by the estimate, the outline is where it was asked to go, the dotted one where the group at hand would have it.

import { useRef } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import { useDevice, usePlayback, useStores } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { ArmFigure, drawArm } from './ArmFigure.tsx';
import { BaseView, drawBase, drawHand, HandView, type InsetLook } from './insets.tsx';
import { armPicture, JOINT, samePicture, type ArmPicture, type Pose } from './pose.ts';
import { usePreview } from './usePreview.ts';
import { motionsInFrame } from './motionInFrame.ts';
import { useMotions } from './useMotions.ts';
import styles from './LiveArm.module.css';

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

/** The ground, the reach of the arm and the foot it stands on. */
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
