// Small drawings of a robot: its body with a dot per servo and a line along each limb, and a servo's limits as a bar. Also the header with
// the way back to the list. Knows no positions.

import type { BodyKind, Robot, RobotServo } from '#shared/profile/robot.ts';
import { useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { UndoTools } from '../undo/UndoTools.tsx';
import dialog from './RobotDialog.module.css';
import robotEditorStyles from './RobotEditor.module.css';
import styles from './RobotPicture.module.css';
import type { Range, Family } from '#shared/codec/families.ts';

/** Back to the list, and Undo: above the editor and the calibration. */
export function RobotHead() {
  const { view, robots } = useStores();
  return (
    <div className={robotEditorStyles.head}>
      <Button tone="quiet" icon="earlier" onPress={() => view.setState({ robotView: 'list' })}>
        {words.robots.back}
      </Button>
      <div className={dialog.undo}>
        <UndoTools of={robots} />
      </div>
    </div>
  );
}

export function RobotPicture({ robot }: { readonly robot: Robot }) {
  return (
    <svg className={styles.picture} viewBox="-8 -8 116 116" aria-hidden="true" focusable="false">
      <path className={styles.trunk} d={TRUNKS[robot.body]} />
      {limbsOf(robot).map((limb) => (
        <path key={limb} className={styles.limb} d={limb} />
      ))}
      {jointsOf(robot).map(({ x, y }) => (
        <circle
          key={`${x} ${y}`}
          className={styles.joint}
          cx={x}
          cy={y}
          r={robot.servos.length > 16 ? 3.5 : 4.5}
        />
      ))}
    </svg>
  );
}

/** The trunk of each body, from the same view as the places of the templates. */
const TRUNKS: Readonly<Record<BodyKind, string>> = {
  arm: 'M34 102H66',
  hand: '',
  humanoid: 'M42 46H58M50 46V14M30 14H70M50 14V0',
  hexapod: 'M38 12H62V88H38Z',
  plain: '',
};

/** An arm's servos have their places beside it, where they can be pressed while it moves; this is the arm itself. */
const ARM = [
  { x: 50, y: 92 },
  { x: 50, y: 72 },
  { x: 30, y: 42 },
  { x: 62, y: 22 },
  { x: 84, y: 34 },
];
const CLAW = 'M84 34L96 30M84 34L90 46';

const jointsOf = ({ body, servos }: Robot): readonly { readonly x: number; readonly y: number }[] =>
  body === 'arm' ? ARM : servos.map(({ place }) => place);

/** A line along each group; the fingers of a hand meet at its last servo; a plain robot has none. */
function limbsOf({ body, servos }: Robot): readonly string[] {
  if (body === 'plain') return [];
  if (body === 'arm') return [chain(ARM), CLAW];
  const last = servos.at(-1);
  if (body === 'hand' && last !== undefined)
    return servos.slice(0, -1).map((finger) => chain([finger.place, last.place]));
  const groups = [...new Set(servos.map(({ group }) => group))];
  return groups.map((name) => chain(servos.filter(({ group }) => group === name).map(({ place }) => place)));
}

const chain = (places: readonly RobotServo['place'][]): string =>
  `M${places.map(({ x, y }) => `${x} ${y}`).join('L')}`;

interface ReachBarProps {
  readonly servo: Pick<RobotServo, 'min' | 'max' | 'home'>;
  readonly reach: Range;
  readonly unit: Family['unit'];
}

/** In percent of the bar: less is invisible. */
const LEAST_WIDTH = 1;

/** A servo's limits within the range of its board, and its home. */
export function ReachBar({ servo: { min, max, home }, reach, unit }: ReachBarProps) {
  const share = (at: number): number => ((at - reach.min) / (reach.max - reach.min)) * 100;
  const width = Math.max(LEAST_WIDTH, share(max) - share(min));
  return (
    <svg
      className={styles.bar}
      viewBox="0 0 100 8"
      preserveAspectRatio="none"
      role="img"
      aria-label={words.robotEditor.reach({ min: reach.min, max: reach.max, unit: words.units[unit] })}
    >
      <rect className={styles.reach} x={0} y={3} width={100} height={2} />
      <rect className={styles.allowed} x={Math.min(share(min), 100 - width)} y={2} width={width} height={4} />
      <path className={styles.home} d={`M${share(home)} 0V8`} />
    </svg>
  );
}
