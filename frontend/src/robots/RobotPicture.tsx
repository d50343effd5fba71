// A robot's build as a small drawing: a dot per servo at its place, a line along each limb. Knows no positions.

import type { BodyKind, Robot, RobotServo } from '#shared/actions/robot/robot.ts';
import styles from './RobotPicture.module.css';

export function RobotPicture({ robot }: { readonly robot: Robot }) {
  return (
    <svg className={styles.picture} viewBox="-8 -8 116 116" aria-hidden="true" focusable="false">
      <path className={styles.trunk} d={TRUNKS[robot.body]} />
      {limbsOf(robot).map((limb) => (
        <path key={limb} className={styles.limb} d={limb} />
      ))}
      {robot.servos.map(({ servo, place: { x, y } }) => (
        <circle key={servo} className={styles.joint} cx={x} cy={y} r={robot.servos.length > 16 ? 3.5 : 4.5} />
      ))}
    </svg>
  );
}

/** What the limbs are on; seen as the places of the ready robots are. */
const TRUNKS: Readonly<Record<BodyKind, string>> = {
  arm: 'M34 102H66',
  hand: '',
  humanoid: 'M42 46H58M50 46V14M30 14H70M50 14V0',
  hexapod: 'M38 12H62V88H38Z',
  plain: '',
};

/** A chain along each group; a hand's fingers meet at its last servo; a plain robot has none. */
function limbsOf({ body, servos }: Robot): readonly string[] {
  if (body === 'plain') return [];
  const last = servos.at(-1);
  if (body === 'hand' && last !== undefined)
    return servos.slice(0, -1).map((finger) => chain([finger, last]));
  const groups = [...new Set(servos.map(({ group }) => group))];
  return groups.map((name) => chain(servos.filter(({ group }) => group === name)));
}

const chain = (servos: readonly RobotServo[]): string =>
  `M${servos.map(({ place: { x, y } }) => `${x} ${y}`).join('L')}`;
