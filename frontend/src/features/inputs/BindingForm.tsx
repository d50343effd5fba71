// What one input is to do: a kind, and what that kind needs.

import { useState } from 'react';
import { FASTEST_UNITS_PER_S, type Action, type Binding } from '#shared/profile/mapping.ts';
import { POSE_MS } from '#shared/profile/pose.ts';
import { PoseSelect } from '../poses/PoseSelect.tsx';
import { useDevice, useRobot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { inputName } from './inputText.ts';
import { servoLabel } from '../../i18n/sentences/servos.ts';
import { words } from '../../i18n/whole.ts';
import { bindingFrom, type Draft } from './draft.ts';
import styles from './BindingForm.module.css';

export interface BindingFormProps {
  readonly initial: Draft;
  onSave(binding: Binding, at: number | null): void;
  onRemove(at: number): void;
  onCancel(): void;
}

const KINDS: readonly Action['kind'][] = ['rate', 'position', 'pose', 'run', 'stop'];

export function BindingForm({ initial, onSave, onRemove, onCancel }: BindingFormProps) {
  const [draft, setDraft] = useState(initial);
  const { at, input, kind, isReversed } = draft;
  const change = (part: Partial<Draft>): void => setDraft({ ...draft, ...part });
  // Letting go of a key must never be what moves a servo.
  const kinds = KINDS.filter((one) => input.kind !== 'key' || one !== 'position');
  const turns = kind === 'rate' || kind === 'position';
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
      {turns && <ServoChoice servo={draft.servo} onChange={(servo) => change({ servo })} />}
      {kind === 'rate' && <Speed value={draft.unitsPerS} onChange={(unitsPerS) => change({ unitsPerS })} />}
      {turns && (
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

function Speed({ value, onChange }: FieldProps) {
  const { notices } = useStores();
  const { unit } = useDevice((state) => state.family);
  const range = { min: 1, max: FASTEST_UNITS_PER_S };
  return (
    <NumberField
      label={words.pad.speedField}
      unit={words.pad.speedUnit({ unit: words.units[unit] })}
      step={10}
      {...{ value, onChange, ...range }}
      onRefused={(wanted) =>
        notices.refuse(
          words.refused({ name: words.pad.speedField, value: wanted, min: range.min, max: range.max }),
        )
      }
    />
  );
}

function Time({ value, onChange }: FieldProps) {
  const { notices } = useStores();
  const { min, max } = POSE_MS;
  return (
    <NumberField
      label={words.poses.time}
      unit={words.servos.ms}
      step={100}
      {...{ value, onChange, min, max }}
      onRefused={(wanted) =>
        notices.refuse(words.refused({ name: words.poses.time, value: wanted, min, max }))
      }
    />
  );
}

function Slot({ value, onChange }: FieldProps) {
  const { notices } = useStores();
  const { min, max } = useDevice((state) => state.family.slot);
  return (
    <NumberField
      label={words.pad.slot}
      {...{ value, onChange, min, max }}
      onRefused={(wanted) => notices.refuse(words.refused({ name: words.pad.slot, value: wanted, min, max }))}
    />
  );
}
