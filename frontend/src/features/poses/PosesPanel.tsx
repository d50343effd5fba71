// The panel of poses: cards, tools for the selected pose, and moving home, to rest or to a pose. The robot moves only by buttons that say
// so.

import { useRef, useState } from 'react';
import { type Pose, setPose } from '#shared/profile/pose.ts';
import { unknownServos } from '#shared/profile/poseShapes.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { useDevice, useRobot, usePoses, useStores, useView } from '../stores.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import { EmptyState, type PanelParts } from '../../ui/Panel.tsx';
import { words } from '../../i18n/whole.ts';
import { runByKey } from '../../ui/action.ts';
import { useCards } from '../../ui/cards.ts';
import { POSE_ACTIONS } from './poseActions.ts';
import { PoseCard } from './PoseCard.tsx';
import { limbsOf } from '../picture/pose.ts';
import { UndoTools } from '../undo/UndoTools.tsx';
import { BlendBar } from './BlendBar.tsx';
import { PoseTools, type Drawer } from './PoseTools.tsx';
import { PoseVerbs } from './PoseVerbs.tsx';
import { useNaming, useSelectedPose } from './naming.ts';
import styles from './PosesPanel.module.css';

/** Shown without poses: what some would look like on the current robot. */
function EmptyPoses() {
  return <EmptyState title={words.poses.empty} hint={words.poses.emptyHint} sketch={<Sketch />} />;
}

/** The sketches' distances from home, as fractions of the way to the limit. */
const SHARES = [-0.4, 0, 0.4];

function Sketch() {
  const { servos } = useRobot();
  const family = useDevice((state) => state.family);
  return (
    <div className={styles.sketch} aria-hidden="true">
      {SHARES.map((share) => (
        <span key={share} className={styles.card}>
          <PoseThumb
            pose={new Map(servos.map((one) => [one.servo, turned(one, share)]))}
            changed={[]}
            family={family}
          />
        </span>
      ))}
    </div>
  );
}

function turned({ home, min, max }: Record<'home' | 'min' | 'max', number>, share: number): number {
  return Math.round(home + share * (share < 0 ? home - min : max - home));
}

function PoseList() {
  const stores = useStores();
  const book = usePoses(({ present }) => present);
  const selected = useView((state) => state.selectedPose);
  const { list, tabStop, key } = useCards<HTMLOListElement>({
    ...{ ids: book.poses.map(({ id }) => id), selected, attribute: 'data-pose' },
    select: (id) => stores.view.setState({ selectedPose: id }),
    act: (pressed, id) => runByKey(Object.values(POSE_ACTIONS), pressed, { stores, id }),
  });

  const marks = ({ id }: Pose): string =>
    [
      book.restId === id ? words.poses.resting : '',
      book.applied === id || (book.applied === 'rest' && book.restId === id) ? words.poses.applied : '',
    ]
      .filter((mark) => mark !== '')
      .join(words.comma);

  return (
    <ol ref={list} className={styles.list} aria-label={words.poses.list} onKeyDown={key}>
      {book.poses.map((pose) => (
        <PoseCard
          key={pose.id}
          pose={pose}
          marks={marks(pose)}
          isSelected={pose.id === selected}
          isTabStop={pose.id === tabStop}
        />
      ))}
    </ol>
  );
}

/** Chooses the servos of a pose. A servo that is added gets its current target; servos that are not in the pose do not move. */
function ServoPicker({ pose }: { readonly pose: Pose }) {
  const { device, poses } = useStores();
  const robot = useRobot();
  const { servos } = robot;
  const known = useDevice((state) => state.known);
  const sameUnit = useDevice((state) => state.family.unit === pose.unit);
  const included = new Set(pose.targets.map(({ servo }) => servo));
  /** Servos from a file that this robot lacks; they can be removed. */
  const unknown = unknownServos(robot, pose.targets);

  function choose(servo: number, isIn: boolean): void {
    const { target: position } = device.motion(servo);
    const others = pose.targets.filter((target) => target.servo !== servo);
    const targets = isIn && position !== null ? [...others, { servo, position }] : others;
    poses.book.edit(
      () => words.poses.steps.servos({ name: pose.name }),
      (book) => setPose(book, pose.id, targets),
    );
  }

  const choice = ({ servo, name }: Pick<RobotServo, 'servo' | 'name'>) => {
    const isIn = included.has(servo);
    const isLast = isIn && included.size === 1;
    return (
      <label key={servo} className={styles.servo}>
        <input
          type="checkbox"
          checked={isIn}
          disabled={isIn ? isLast : !sameUnit || !known.includes(servo)}
          onChange={({ target }) => choose(servo, target.checked)}
        />
        {name}
      </label>
    );
  };

  return (
    <fieldset
      className={styles.drawer}
      aria-label={words.poses.servosOf({ count: included.size, all: servos.length + unknown.length })}
    >
      <p className={styles.hint}>{words.poses.servosHint}</p>
      <div className={styles.limbs}>
        {limbsOf(servos).map(({ group, servos: members }) => (
          <fieldset key={group} className={styles.limb}>
            {group !== '' && <legend className={styles.limbName}>{group}</legend>}
            <div className={styles.servos}>{members.map(choice)}</div>
          </fieldset>
        ))}
        {unknown.map((servo) => choice({ servo, name: words.robots.absent({ servo }) }))}
      </div>
    </fieldset>
  );
}

export const posesParts: PanelParts = {
  title: () => words.poses.title,
  Tools,
  Content,
  className: styles.panel,
};

function Tools() {
  return <UndoTools of={useStores().poses.book} />;
}

function Content() {
  const isEmpty = usePoses(({ present }) => present.poses.length === 0);
  const pose = useSelectedPose();
  const [drawer, setDrawer] = useState<Drawer | null>(null);
  const cards = useRef<HTMLDivElement>(null);
  const name = useNaming(cards);
  return (
    <>
      <div ref={cards} className={styles.cards}>
        {isEmpty ? <EmptyPoses /> : <PoseList />}
      </div>
      <PoseTools drawer={drawer} onDrawer={setDrawer} />
      {pose !== undefined && drawer === 'servos' && <ServoPicker pose={pose} />}
      {pose !== undefined && drawer === 'blend' && <BlendBar key={pose.id} pose={pose} />}
      <PoseVerbs onNew={name} />
    </>
  );
}
