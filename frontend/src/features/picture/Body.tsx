// The picture of the robot above its servos: an arm, a body by bones, or dials for a body without a description.

import { useRef } from 'react';
import type { Family } from '#shared/codec/families.ts';
import { select } from '../servoView.ts';
import { editServoView, useDevice, useRobot, useServoView, useStores } from '../stores.ts';
import { cx } from '../../ui/cx.ts';
import { Canvas, type Size } from './Canvas.tsx';
import { words } from '../../i18n/words.ts';
import { DialFace, paintNeedles, type Spot } from './Dial.tsx';
import { motionInFrame, usePreview } from './motion.ts';
import { dialDegrees, halfDegree, type Pose } from './pose.ts';
import { UnknownNote } from './UnknownNote.tsx';
import overlay from './overlay.module.css';
import styles from './Body.module.css';
import { laterComponent } from '../../ui/later.tsx';

/** Up to this number the dials are large enough to be read from a distance. */
const FEW = 12;

function Dials() {
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const selected = useServoView((view) => view.selected);
  const { servos } = useRobot();
  const list = useRef<HTMLOListElement>(null);
  return (
    <div className={styles.room}>
      <div className={styles.board}>
        <ol ref={list} className={cx(styles.dials, servos.length > FEW && styles.many)}>
          {servos.map(({ servo }) => (
            <li
              key={servo}
              className={cx(styles.dial, selected.includes(servo) && styles.selected)}
              onPointerDown={() => editServoView(stores, (view) => select(view, [servo]))}
            >
              <DialFace servo={servo} />
              {words.numbers.formatWhole(servo)}
            </li>
          ))}
        </ol>
        <AllNeedles list={list} servos={servos.map(({ servo }) => servo)} family={family} />
      </div>
    </div>
  );
}

/** Where the faces are; they move only when the list is resized. */
interface Faces {
  readonly size: Size | null;
  readonly diameter: number;
  readonly spots: readonly Spot[];
}

interface AllNeedlesProps {
  readonly list: React.RefObject<HTMLElement | null>;
  readonly servos: readonly number[];
  readonly family: Family;
}

function AllNeedles({ list, servos, family }: AllNeedlesProps) {
  const { device } = useStores();
  const pose = useRef<Pose | null>(null);
  const faces = useRef<Faces>({ size: null, diameter: 0, spots: [] });
  usePreview((now) => (pose.current = now));
  const turn = (position: number | null): number | null =>
    position === null ? null : halfDegree(dialDegrees(position, family));

  function facesAt(size: Size): Faces {
    const isMeasured = faces.current.size === size && faces.current.spots.length === servos.length;
    if (!isMeasured && list.current !== null) faces.current = { size, ...facesIn(list.current) };
    return faces.current;
  }

  return (
    <Canvas
      className={overlay.over}
      shown={() =>
        servos.flatMap((servo) => {
          const { target, estimated } = motionInFrame(device, servo);
          return [turn(target), turn(estimated), turn(pose.current?.(servo) ?? null)];
        })
      }
      paint={({ ctx, look, size }, shown) => {
        const { diameter, spots } = facesAt(size);
        const dials = spots.map((spot, index) => {
          const [target = null, needle = null, preview = null] = shown.slice(3 * index, 3 * index + 3);
          return { spot, needles: { target, needle, preview } };
        });
        paintNeedles(ctx, look, diameter, dials);
      }}
    />
  );
}

function facesIn(list: HTMLElement): Pick<Faces, 'diameter' | 'spots'> {
  const from = list.getBoundingClientRect();
  const boxes = [...list.querySelectorAll('svg')].map((face) => face.getBoundingClientRect());
  const spots = boxes.map(({ left, top, width, height }) => ({
    x: left - from.left + width / 2,
    y: top - from.top + height / 2,
  }));
  return { diameter: boxes[0]?.width ?? 0, spots };
}

export function Body() {
  const isPlain = useRobot().body === 'plain';
  return (
    <div className={cx(styles.body, isPlain && styles.plain)}>
      <BodyPicture />
      <UnknownNote />
    </div>
  );
}

export function BodyPicture() {
  const { body } = useRobot();
  if (body === 'plain') return <Dials />;
  return body === 'arm' ? (
    <div className={styles.arm}>
      <LiveArm />
    </div>
  ) : (
    <div className={styles.bones}>
      <LiveBones />
    </div>
  );
}

export const LiveArm = laterComponent(async () => (await import('./LiveArm.tsx')).LiveArm, '0');
export const LiveBones = laterComponent(async () => (await import('./LiveArm.tsx')).LiveBones, '0');
/** In three dimensions; its library is large, so it is loaded only on demand. */
export const RobotView = laterComponent(
  async () => (await import('./three/RobotView.tsx')).RobotView,
  '0',
  'onDemand',
);
