// The form for one binding: the kind of action and its values.

import { useState } from 'react';
import {
  FASTEST_MM_PER_S,
  FASTEST_UNITS_PER_S,
  TIP_AXES,
  type Action,
  type Binding,
  canPlace,
  type Input,
  isOfTip,
  usualUnitsPerS,
} from '#shared/profile/mapping.ts';
import { type PoseRef, POSE_MS } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { PoseSelect } from '../poses/PoseSelect.tsx';
import { useDevice, useMapping, useRobot } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { CheckedNumber } from '../CheckedNumber.tsx';
import { Select } from '../../ui/Select.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { inputName } from './rows.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import styles from './BindingForm.module.css';

/** A binding while it is edited: every field has a value, whatever the kind of action. */
export interface Draft {
  /** Its index in the list; null for a new binding. */
  readonly at: number | null;
  readonly input: Input;
  readonly kind: Action['kind'];
  readonly servo: number;
  /** Always positive; `isReversed` is the direction. */
  readonly unitsPerS: number;
  readonly axis: (typeof TIP_AXES)[number];
  /** Always positive. */
  readonly mmPerS: number;
  readonly isReversed: boolean;
  readonly slot: number;
  readonly pose: PoseRef;
  readonly durationMs: number;
}

/** A stick that was pushed to its minus side increases the value there. */
export function draftFor(input: Input, { servos }: Robot): Draft {
  const [first] = servos;
  const unitsPerS = first === undefined ? FASTEST_UNITS_PER_S : usualUnitsPerS(first);
  const isReversed = 'side' in input && input.side === 'minus';
  return { at: null, input, kind: 'rate', servo: first?.servo ?? 1, unitsPerS, isReversed, ...NOT_SHOWN };
}

/** Values for fields that the action does not have. */
const NOT_SHOWN = { axis: 'x', mmPerS: 80, slot: 0, pose: 'home', durationMs: GENTLE_MOVE_MS } as const;

export function draftOf(at: number, { input, action }: Binding, robot: Robot): Draft {
  const draft = { ...draftFor(input, robot), at, kind: action.kind };
  if (action.kind === 'run') return { ...draft, slot: action.slot };
  if (action.kind === 'pose') return { ...draft, pose: action.pose, durationMs: action.durationMs };
  if (action.kind === 'stop') return draft;
  if (action.kind === 'position') return { ...draft, servo: action.servo, isReversed: action.isReversed };
  if (action.kind === 'tip') {
    const { axis, mmPerS } = action;
    return { ...draft, axis, mmPerS: Math.abs(mmPerS), isReversed: mmPerS < 0 };
  }
  const { servo, unitsPerS } = action;
  return { ...draft, servo, unitsPerS: Math.abs(unitsPerS), isReversed: unitsPerS < 0 };
}

/** What moves a servo or a tip uses a whole axis, other actions only the side that was pushed. */
function bindingFrom({ input, kind, ...draft }: Draft): Binding {
  const { servo, isReversed, slot, pose, durationMs } = draft;
  if (kind === 'run') return { input, action: { kind, slot } };
  if (kind === 'pose') return { input, action: { kind, pose, durationMs } };
  if (kind === 'stop') return { input, action: { kind } };
  const whole: Input = 'side' in input ? { ...input, side: 'whole' } : input;
  if (kind === 'position') return { input: whole, action: { kind, servo, isReversed } };
  if (kind === 'tip') {
    const mmPerS = isReversed ? -draft.mmPerS : draft.mmPerS;
    return { input: whole, action: { kind, axis: draft.axis, mmPerS } };
  }
  const unitsPerS = isReversed ? -draft.unitsPerS : draft.unitsPerS;
  return { input: whole, action: { kind, servo, unitsPerS } };
}

interface BindingFormProps {
  readonly initial: Draft;
  onSave(binding: Binding, at: number | null): void;
  onRemove(at: number): void;
  onCancel(): void;
}

const KINDS: readonly Action['kind'][] = ['tip', 'rate', 'position', 'pose', 'run', 'stop'];

export function BindingForm({ initial, onSave, onRemove, onCancel }: BindingFormProps) {
  const [draft, setDraft] = useState(initial);
  const { at, input, kind, isReversed } = draft;
  const change = (part: Partial<Draft>): void => setDraft({ ...draft, ...part });
  const isTip = isOfTip(useMapping());
  const kinds = KINDS.filter((one) => {
    if (one === 'tip') return isTip;
    return one !== 'position' || canPlace(input);
  });
  const movesServo = kind === 'rate' || kind === 'position';
  const name = inputName(input);
  return (
    <form
      className={styles.form}
      aria-label={words.pad.form({ input: name })}
      onSubmit={(event) => {
        event.preventDefault();
        onSave(bindingFrom(draft), at);
      }}
    >
      <strong className={styles.input}>{name}</strong>
      <select
        autoFocus
        className={styles.select}
        aria-label={words.pad.does}
        value={kind}
        onChange={(event) => change({ kind: event.target.value as Action['kind'] })}
      >
        {kinds.map((one) => (
          <option key={one} value={one}>
            {words.pad.actions[one]}
          </option>
        ))}
      </select>
      {movesServo && <ServoChoice servo={draft.servo} onChange={(servo) => change({ servo })} />}
      {kind === 'rate' && <Speed value={draft.unitsPerS} onChange={(unitsPerS) => change({ unitsPerS })} />}
      {kind === 'tip' && (
        <>
          <Select
            label={words.pad.tipAxis}
            value={draft.axis}
            options={TIP_AXES.map((axis) => ({ value: axis, label: words.robot3d.axes[axis] }))}
            onChange={(axis) => change({ axis })}
          />
          <TipSpeedField value={draft.mmPerS} onChange={(mmPerS) => change({ mmPerS })} />
        </>
      )}
      {(movesServo || kind === 'tip') && (
        <Toggle label={words.pad.reversed} isOn={isReversed} onChange={(on) => change({ isReversed: on })} />
      )}
      {kind === 'pose' && (
        <>
          <PoseSelect label={words.pad.pose} value={draft.pose} onChange={(pose) => change({ pose })} />
          <Time value={draft.durationMs} onChange={(durationMs) => change({ durationMs })} />
        </>
      )}
      {kind === 'run' && <Slot value={draft.slot} onChange={(slot) => change({ slot })} />}
      <div className={styles.buttons}>
        <Button type="submit" tone="primary">
          {words.pad.save}
        </Button>
        {at !== null && <Button onPress={() => onRemove(at)}>{words.pad.remove}</Button>}
        <Button tone="quiet" onPress={onCancel}>
          {words.pad.cancel}
        </Button>
      </div>
    </form>
  );
}

interface FieldProps {
  readonly value: number;
  onChange(value: number): void;
}

function ServoChoice({ servo, onChange }: { readonly servo: number; onChange(servo: number): void }) {
  const { servos } = useRobot();
  return (
    <select
      className={styles.select}
      aria-label={words.pad.servo}
      value={servo}
      onChange={(event) => onChange(Number(event.target.value))}
    >
      {servos.map((one) => (
        <option key={one.servo} value={one.servo}>
          {servoLabel(one)}
        </option>
      ))}
    </select>
  );
}

function TipSpeedField({ value, onChange }: FieldProps) {
  const range = { min: 1, max: FASTEST_MM_PER_S };
  return (
    <CheckedNumber
      label={words.pad.tipSpeed}
      unit={words.pad.mmPerS}
      step={5}
      {...{ value, onChange, ...range }}
    />
  );
}

function Speed({ value, onChange }: FieldProps) {
  const { unit } = useDevice((state) => state.family);
  const range = { min: 1, max: FASTEST_UNITS_PER_S };
  return (
    <CheckedNumber
      label={words.pad.speedField}
      unit={words.pad.speedUnit({ unit: words.units[unit] })}
      step={10}
      {...{ value, onChange, ...range }}
    />
  );
}

function Time({ value, onChange }: FieldProps) {
  const { min, max } = POSE_MS;
  return (
    <CheckedNumber
      label={words.poses.time}
      unit={words.servos.ms}
      step={100}
      {...{ value, onChange, min, max }}
    />
  );
}

function Slot({ value, onChange }: FieldProps) {
  const { min, max } = useDevice((state) => state.family.slot);
  return <CheckedNumber label={words.pad.slot} {...{ value, onChange, min, max }} />;
}
