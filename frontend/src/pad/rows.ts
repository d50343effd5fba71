// The bindings as a table: a row per servo of the robot, then what else is bound. Knows no drawing.

import { servoBoundBy, type Binding, type Mapping } from '#shared/actions/mapping/mapping.ts';
import type { PoseBook } from '#shared/actions/poses/pose.ts';
import { servoOf, type Robot } from '#shared/actions/robot/robot.ts';
import { poseName } from '../stores/driving/poses.ts';
import { words } from '../words/words.ts';

export interface Row {
  readonly title: string;
  /** Places in the mapping's list. */
  readonly bindings: readonly number[];
}

/** What a binding does, for its row. */
export function rowTitle(binding: Binding, robot: Robot, book: PoseBook): string {
  const servo = servoBoundBy(binding);
  if (servo !== null) return servoOf(robot, servo)?.name ?? words.pad.absent(servo);
  const { action } = binding;
  if (action.kind === 'pose') return words.pad.poseRow(poseName(book, action.pose));
  return action.kind === 'run' ? words.pad.slotRow(action.slot) : words.pad.stopRow;
}

/** Servos are there without a binding too. Two servos of one name share a row, and are not to be told apart anywhere else. */
export function rowsOf({ bindings }: Mapping, robot: Robot, book: PoseBook): readonly Row[] {
  const titles = bindings.map((binding) => rowTitle(binding, robot, book));
  const all = new Set([...robot.servos.map(({ name }) => name), ...titles]);
  return [...all].map((title) => ({
    title,
    bindings: titles
      .flatMap((one, at) => (one === title ? [at] : []))
      .toSorted((one, other) => placeInRow(bindings[one]) - placeInRow(bindings[other])),
  }));
}

const ORDER = ['axis', 'button', 'key'] as const;

const placeInRow = (binding: Binding | undefined): number => ORDER.indexOf(binding?.input.kind ?? 'key');
