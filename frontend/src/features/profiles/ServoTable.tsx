// The table of the current robot's servos: how each column shows its value, and the robot that results from a typed text. An invalid
// change is explained below its row and not applied.

import type { Label } from '#shared/document/history.ts';
import { useId, useState, type KeyboardEvent } from 'react';
import { flawOf, type Robot, type RobotServo } from '#shared/profile/robot.ts';
import { changeServo, pair, reachOf, removeServo, renumber } from '#shared/profile/robotEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { useRobot, useStores } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { robotFlawSentence } from '../../i18n/robotFlaws.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { ReachBar } from './RobotPicture.tsx';
import styles from './ServoTable.module.css';
import { actionOf } from '../../ui/action.ts';
import { UNDO_ACTIONS } from '../undo/UndoTools.tsx';

export type ColumnId = 'servo' | 'name' | 'group' | 'min' | 'home' | 'max' | 'trim' | 'degreesPerUnit';

export type Edited = { readonly robot: Robot } | { readonly problem: string };

export interface Column {
  readonly id: ColumnId;
  readonly isNumber: boolean;
  show(servo: RobotServo): string;
  edit(robot: Robot, servo: RobotServo, text: string): Edited;
}

const whole =
  (take: (robot: Robot, servo: number, value: number) => Robot): Column['edit'] =>
  (robot, { servo }, text) => {
    const value = Number(text);
    if (text.trim() === '' || !Number.isInteger(value))
      return { problem: words.robotEditor.notWhole({ text }) };
    return { robot: take(robot, servo, value) };
  };

const figure = (id: 'min' | 'home' | 'max' | 'trim'): Column => ({
  id,
  isNumber: true,
  show: (servo) => String(servo[id]),
  edit: whole((robot, servo, value) => changeServo(robot, servo, { [id]: value })),
});

export const COLUMNS: readonly Column[] = [
  { id: 'servo', isNumber: true, show: ({ servo }) => String(servo), edit: whole(renumber) },
  {
    id: 'name',
    isNumber: false,
    show: ({ name }) => name,
    edit: (robot, { servo }, text) =>
      text.trim() === ''
        ? { problem: words.robotEditor.noName }
        : { robot: changeServo(robot, servo, { name: text.trim() }) },
  },
  {
    id: 'group',
    isNumber: false,
    show: ({ group }) => group,
    edit: (robot, { servo }, text) => ({ robot: changeServo(robot, servo, { group: text.trim() }) }),
  },
  figure('min'),
  figure('home'),
  figure('max'),
  figure('trim'),
  {
    id: 'degreesPerUnit',
    isNumber: true,
    show: ({ degreesPerUnit }) => String(degreesPerUnit),
    edit(robot, { servo }, text) {
      const degreesPerUnit = Number(text.replace(',', '.'));
      if (text.trim() === '' || Number.isNaN(degreesPerUnit))
        return { problem: words.robotEditor.notNumber({ text }) };
      return { robot: changeServo(robot, servo, { degreesPerUnit }) };
    },
  },
];

export function ServoTable() {
  const { servos, board } = useRobot();
  const { unit } = FAMILIES[board];
  const titles = {
    ...words.robotEditor.columns,
    degreesPerUnit: words.robotEditor.degreesPer[unit],
  };
  return (
    <div className={styles.table}>
      <div className={styles.titles} aria-hidden="true">
        {COLUMNS.map(({ id, isNumber }) => (
          <span key={id} data-number={isNumber}>
            {titles[id]}
          </span>
        ))}
        <span>{words.robotEditor.reversed}</span>
        <span>{words.robotEditor.mirror}</span>
      </div>
      <ol aria-label={words.robotEditor.servos}>
        {servos.map((servo) => (
          <ServoLine key={servo.servo} servo={servo} titles={titles} />
        ))}
      </ol>
    </div>
  );
}

interface ServoLineProps {
  readonly servo: RobotServo;
  readonly titles: Readonly<Record<ColumnId, string>>;
}

function ServoLine({ servo, titles }: ServoLineProps) {
  const robot = useRobot();
  const { robots } = useStores();
  const called = servoLabel(servo);
  const [problems, setProblems] = useState<Partial<Record<ColumnId, string>>>({});
  const problemId = useId();

  const change = (what: Label, edit: (robot: Robot) => Robot): boolean =>
    robots.edit(() => words.robotEditor.step({ column: what(), servo: called }), edit);

  function take(column: Column, text: string): boolean {
    const isSame = text === column.show(servo);
    const edited = isSame ? { robot } : column.edit(robot, servo, text);
    const problem = problemOf(edited);
    setProblems(({ [column.id]: _, ...others }) =>
      problem === null ? others : { ...others, [column.id]: problem },
    );
    return (
      'robot' in edited &&
      problem === null &&
      change(
        () => words.robotEditor.columns[column.id],
        () => edited.robot,
      )
    );
  }

  return (
    <li className={styles.line} aria-label={words.robotEditor.row({ servo: servo.servo, name: called })}>
      {COLUMNS.map((column) => (
        <label key={column.id} className={styles.cell} data-cell={column.id}>
          <span className={styles.title}>{titles[column.id]}</span>
          <CellField
            label={words.robotEditor.cell({ column: titles[column.id], servo: called })}
            value={column.show(servo)}
            isNumber={column.isNumber}
            column={column.id}
            problemId={problems[column.id] === undefined ? undefined : problemId}
            onTake={(text) => take(column, text)}
          />
        </label>
      ))}
      <label className={styles.check}>
        <span className={styles.title}>{words.robotEditor.reversed}</span>
        <input
          type="checkbox"
          aria-label={words.robotEditor.cell({ column: words.robotEditor.reversed, servo: called })}
          checked={servo.isReversed}
          onChange={(event) => {
            const isReversed = event.target.checked;
            change(
              () => words.robotEditor.reversed,
              (all) => changeServo(all, servo.servo, { isReversed }),
            );
          }}
        />
      </label>
      <label className={styles.cell} data-cell="mirror">
        <span className={styles.title}>{words.robotEditor.mirror}</span>
        <Mirror
          servo={servo}
          others={robot.servos}
          onChange={(partner) =>
            change(
              () => words.robotEditor.mirror,
              (all) => pair(all, servo.servo, partner),
            )
          }
        />
      </label>
      <IconButton
        icon="trash"
        label={words.robotEditor.remove({ name: called })}
        isDisabled={robot.servos.length === 1}
        onPress={() =>
          robots.edit(
            () => words.robotEditor.removeStep({ name: called }),
            (all) => removeServo(all, servo.servo),
          )
        }
      />
      <ReachBar servo={servo} reach={reachOf(robot, servo)} unit={FAMILIES[robot.board].unit} />
      <p id={problemId} className={styles.problem} role="alert">
        {Object.values(problems).join(' ')}
      </p>
    </li>
  );
}

function problemOf(edited: Edited): string | null {
  if ('problem' in edited) return edited.problem;
  const flaw = flawOf(edited.robot);
  return flaw === null ? null : robotFlawSentence(flaw);
}

interface MirrorProps {
  readonly servo: RobotServo;
  readonly others: readonly RobotServo[];
  onChange(partner: number | null): void;
}

function Mirror({ servo: { servo, name, group, mirror }, others, onChange }: MirrorProps) {
  return (
    <select
      className={styles.input}
      aria-label={words.robotEditor.cell({
        column: words.robotEditor.mirror,
        servo: servoLabel({ name, group }),
      })}
      value={mirror ?? ''}
      onChange={({ target: { value } }) => onChange(value === '' ? null : Number(value))}
    >
      <option value="">{words.robotEditor.noMirror}</option>
      {others
        .filter((other) => other.servo !== servo)
        .map((other) => (
          <option key={other.servo} value={other.servo}>
            {words.robotEditor.row({ servo: other.servo, name: servoLabel(other) })}
          </option>
        ))}
    </select>
  );
}

interface CellFieldProps {
  readonly label: string;
  readonly value: string;
  readonly isNumber?: boolean;
  readonly column?: string;
  /** The id of the element that explains an error. */
  readonly problemId?: string | undefined;
  readonly maxLength?: number;
  /** Returns false if the text is invalid. */
  onTake(text: string): boolean;
}

/**
 * A value of the table as a text field. Applied on Enter or when the field loses the focus; an invalid text stays in the field, which is
 * marked. Enter continues in the same column of the next row.
 */
export function CellField(props: CellFieldProps) {
  const { label, value, isNumber = false, column, problemId, maxLength = 64 } = props;
  const [draft, setDraft] = useState<string | null>(null);

  function leave(): void {
    if (draft === null) return;
    if (props.onTake(draft)) setDraft(null);
  }

  function key(event: KeyboardEvent<HTMLInputElement>): void {
    if (event.key === 'Enter') {
      // Losing the focus applies the text; the last row has no next field.
      const neighbour = neighbourOf(event.currentTarget, event.shiftKey ? -1 : 1);
      if (neighbour === undefined) leave();
      else neighbour.focus();
    }
    // While typing, the browser's undo applies.
    if (draft !== null && actionOf(UNDO_ACTIONS, event) !== undefined) event.stopPropagation();
  }

  return (
    <input
      className={styles.input}
      aria-label={label}
      aria-invalid={problemId !== undefined}
      aria-describedby={problemId}
      data-column={column}
      data-number={isNumber}
      inputMode={isNumber ? 'decimal' : 'text'}
      maxLength={maxLength}
      autoComplete="off"
      spellCheck={false}
      value={draft ?? value}
      onChange={(event) => setDraft(event.target.value)}
      onFocus={(event) => event.target.select()}
      onBlur={leave}
      onKeyDown={key}
    />
  );
}

function neighbourOf(input: HTMLInputElement, step: 1 | -1): HTMLInputElement | undefined {
  const { column } = input.dataset;
  const list = input.closest('ol');
  if (column === undefined || list === null) return undefined;
  const cells = [...list.querySelectorAll<HTMLInputElement>(`[data-column='${column}']`)];
  return cells[cells.indexOf(input) + step];
}
