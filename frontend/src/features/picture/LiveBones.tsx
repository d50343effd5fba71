// A body by bones as the session's motion goes: solid is where it is by the estimate, the outline where it was asked to go, the
// dotted one where the group at hand would have it.

import { useRef } from 'react';
import type { Robot } from '#shared/profile/robot.ts';
import type { Motions } from '#shared/robot/state.ts';
import { usePlayback, useRobot, useStores } from '../stores.ts';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/words.ts';
import { BoneFigure, drawBones } from './ArmFigure.tsx';
import { bonesOf, type BonePicture } from './bones.ts';
import { usePreview } from './usePreview.ts';
import { motionsInFrame } from './motionInFrame.ts';
import { reachOf, viewBoxOf } from './reach.ts';
import { useMotions } from './useMotions.ts';
import styles from './LiveBones.module.css';

const SHOWN = ['estimated', 'target'] as const;
/** In board units: what no eye can tell apart in the picture. */
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

/** Where all of it is where it was asked to be the outline says nothing. */
function ghostVisibility({ servos }: Robot, motion: Motions): 'visible' | 'hidden' {
  const isThere = servos.every(({ servo }) => {
    const { target, estimated } = motion(servo);
    return target === null || (estimated !== null && Math.abs(target - estimated) < SAME);
  });
  return isThere ? 'hidden' : 'visible';
}
