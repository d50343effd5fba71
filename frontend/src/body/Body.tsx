// The picture of the robot: a six-servo arm from the side, its base from above and its hand from the front. Solid is where
// it is by the estimate, the outline is where it was asked to go. Other servo counts have their dials instead.

import { useRef } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import { select } from '../stores/servoView.ts';
import { editServoView, useDevice, useRobot, useServoView, useStores } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { words } from '../words/en.ts';
import { formatWhole } from '../words/numbers.ts';
import { Dial } from './Dial.tsx';
import { ArmFigure, drawArm } from './ArmFigure.tsx';
import { armPicture, JOINT, samePicture, type ArmPicture, type Pose } from './pose.ts';
import { BaseView, drawBase, drawHand, HandView } from './insets.tsx';
import { sameMotion } from './useMotion.ts';
import styles from './Body.module.css';

export function Body() {
  const { device } = useStores();
  const { body, servos } = useRobot();
  // Moved by nobody, and nothing told by the board: the motion changes with the store.
  const unknown = useDevice(({ targets }) =>
    servos.every(({ servo }) => targets[servo] === undefined && device.motion(servo).estimated === null),
  );
  return (
    <div className={styles.body}>
      {body === 'arm' ? <Arm /> : <Dials />}
      <p className={styles.note}>{unknown ? words.body.allUnknown : ''}</p>
    </div>
  );
}

/** A robot whose body nobody described: its dials, large enough to read across the room. */
function Dials() {
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const selected = useServoView((view) => view.selected);
  const { servos } = useRobot();
  return (
    <ol className={styles.dials}>
      {servos.map(({ servo }) => (
        <li
          key={servo}
          className={cx(styles.dial, selected.includes(servo) && styles.selected)}
          onPointerDown={() => editServoView(stores, (view) => select(view, [servo]))}
        >
          <Dial servo={servo} family={family} />
          {formatWhole(servo)}
        </li>
      ))}
    </ol>
  );
}

function Arm() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const frame = useRef<HTMLDivElement>(null);
  const drawn = useRef<readonly ServoMotion[]>([]);
  const pictureOf = (value: (motion: ServoMotion) => number | null): ArmPicture => {
    const pose: Pose = (servo) => value(device.motion(servo));
    return armPicture(pose, family);
  };
  const estimated = (): ArmPicture => pictureOf((motion) => motion.estimated);
  const commanded = (): ArmPicture => pictureOf((motion) => motion.target);

  useEachFrame(() => {
    const motions = ARM_SERVOS.map(device.motion);
    const moved = motions.some((motion, index) => {
      const before = drawn.current[index];
      return before === undefined || !sameMotion(before, motion);
    });
    if (!moved || frame.current === null) return;
    drawn.current = motions;
    draw(frame.current, estimated(), commanded());
  });

  return (
    <div className={styles.views} ref={frame}>
      <svg className={styles.side} viewBox="-250 -252 500 304" role="img" aria-label={words.body.figure}>
        <Floor />
        <g data-figure="estimated">
          <ArmFigure picture={estimated()} look="solid" />
        </g>
        <g data-figure="commanded">
          <ArmFigure picture={commanded()} look="ghost" />
        </g>
      </svg>
      <div className={styles.insets}>
        <BaseView estimated={estimated()} commanded={commanded()} />
        <HandView estimated={estimated()} commanded={commanded()} />
      </div>
    </div>
  );
}

const ARM_SERVOS = Object.values(JOINT);

function draw(frame: HTMLElement, estimated: ArmPicture, commanded: ArmPicture): void {
  const isThere = samePicture(estimated, commanded);
  for (const [name, picture] of [
    ['estimated', estimated],
    ['commanded', commanded],
  ] as const) {
    const figure = frame.querySelector<SVGGElement>(`[data-figure='${name}']`);
    if (figure !== null) drawArm(figure, picture);
    if (name === 'commanded') figure?.setAttribute('visibility', isThere ? 'hidden' : 'visible');
    drawBase(frame, name, picture);
    drawHand(frame, name, picture);
  }
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
