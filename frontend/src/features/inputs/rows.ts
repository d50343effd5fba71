// The bindings as a table: a row per servo of the robot, then what else is bound. Knows no drawing.

import { servoBoundBy, type Binding, type Mapping } from '#shared/profile/mapping.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import { servoOf, type Robot } from '#shared/profile/robot.ts';
import { poseName } from '../poses/poses.ts';
import { servoLabel } from '../../i18n/sentences/servos.ts';
import { words } from '../../i18n/whole.ts';

export interface Row {
  readonly id: string;
  readonly title: string;
  /** Places in the mapping's list. */
  readonly bindings: readonly number[];
}

/** What a binding does, for its row. */
export function rowTitle(binding: Binding, robot: Robot, book: PoseBook): string {
  const servo = servoBoundBy(binding);
  if (servo !== null) return servoTitle(robot, servo);
  const { action } = binding;
  if (action.kind === 'pose') return words.pad.poseRow({ pose: poseName(book, action.pose) });
  return action.kind === 'run' ? words.pad.slotRow({ slot: action.slot }) : words.pad.stopRow;
}

export function servoTitle(robot: Robot, servo: number): string {
  const own = servoOf(robot, servo);
  return own === undefined ? words.robots.absent({ servo }) : servoLabel(own);
}

/** Servos are there without a binding too. */
export function rowsOf({ bindings }: Mapping, robot: Robot, book: PoseBook): readonly Row[] {
  const ids = bindings.map((binding) => rowId(binding, rowTitle(binding, robot, book)));
  const titles = new Map([
    ...robot.servos.map(({ servo }) => [servoRowId(servo), servoTitle(robot, servo)] as const),
    ...bindings.map((binding, at) => [ids[at] ?? '', rowTitle(binding, robot, book)] as const),
  ]);
  return [...titles].map(([id, title]) => ({
    ...{ id, title },
    bindings: ids
      .flatMap((one, at) => (one === id ? [at] : []))
      .toSorted((one, other) => placeInRow(bindings[one]) - placeInRow(bindings[other])),
  }));
}

const servoRowId = (servo: number): string => `servo ${servo}`;

/** Whatever else is called alike does the same. */
function rowId(binding: Binding, title: string): string {
  const servo = servoBoundBy(binding);
  return servo === null ? title : servoRowId(servo);
}

const ORDER = ['axis', 'button', 'key'] as const;

const placeInRow = (binding: Binding | undefined): number => ORDER.indexOf(binding?.input.kind ?? 'key');
