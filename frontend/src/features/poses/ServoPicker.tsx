// Which servos a pose is about. One that is put in takes the place it is commanded to now; one that is left out stays where
// it is when the pose is gone to.

import { type Pose, setPose } from '#shared/profile/pose.ts';
import { strangersTo } from '#shared/profile/poseShapes.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { limbsOf } from '../picture/limbs.ts';
import { useDevice, useRobot, useStores } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import styles from './PosesPanel.module.css';

export function ServoPicker({ pose }: { readonly pose: Pose }) {
  const { device, poses } = useStores();
  const robot = useRobot();
  const { servos } = robot;
  const known = useDevice((state) => state.known);
  const sameUnit = useDevice((state) => state.family.unit === pose.unit);
  const included = new Set(pose.targets.map(({ servo }) => servo));
  /** Of a file: they can be left out. */
  const strangers = strangersTo(robot, pose.targets);

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
      aria-label={words.poses.servosOf({ count: included.size, all: servos.length + strangers.length })}
    >
      <p className={styles.hint}>{words.poses.servosHint}</p>
      <div className={styles.limbs}>
        {limbsOf(servos).map(({ group, servos: members }) => (
          <fieldset key={group} className={styles.limb}>
            {group !== '' && <legend className={styles.limbName}>{group}</legend>}
            <div className={styles.servos}>{members.map(choice)}</div>
          </fieldset>
        ))}
        {strangers.map((servo) => choice({ servo, name: words.robots.absent({ servo }) }))}
      </div>
    </fieldset>
  );
}
