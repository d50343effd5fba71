// The fields of one step: a pose and its duration, a slot and its repetitions, or a wait.

import { SLOT, SLOT_TIMES, WAIT_MS, type MacroStep } from '#shared/profile/macro.ts';
import { POSE_MS } from '#shared/profile/pose.ts';
import type { Range } from '#shared/codec/families.ts';
import { PoseSelect } from '../poses/PoseSelect.tsx';
import { useStores } from '../stores.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './MacroEditor.module.css';

export interface StepFieldsProps<Step extends MacroStep = MacroStep> {
  readonly step: Step;
  readonly number: number;
  onChange(step: MacroStep): void;
}

type FieldsOf<Kind extends MacroStep['kind']> = StepFieldsProps<Extract<MacroStep, { kind: Kind }>>;

export function StepFields({ step, ...rest }: StepFieldsProps) {
  if (step.kind === 'pose') return <PoseFields step={step} {...rest} />;
  if (step.kind === 'slot') return <SlotFields step={step} {...rest} />;
  return <WaitFields step={step} {...rest} />;
}

function PoseFields({ step, number, onChange }: FieldsOf<'pose'>) {
  return (
    <>
      <PoseSelect
        label={words.macros.stepPose({ number })}
        value={step.pose}
        onChange={(pose) => onChange({ ...step, pose })}
      />
      <Field
        label={words.macros.stepMs({ number })}
        value={step.durationMs}
        range={POSE_MS}
        step={100}
        unit={words.servos.ms}
        onChange={(durationMs) => onChange({ ...step, durationMs })}
      />
    </>
  );
}

function SlotFields({ step, number, onChange }: FieldsOf<'slot'>) {
  return (
    <>
      <span className={styles.pair}>
        <span aria-hidden="true">{words.board.slot}</span>
        <Field
          label={words.macros.stepSlot({ number })}
          value={step.slot}
          range={SLOT}
          onChange={(slot) => onChange({ ...step, slot })}
        />
      </span>
      <Field
        label={words.macros.stepTimes({ number })}
        value={step.times}
        range={SLOT_TIMES}
        unit={words.macros.times}
        onChange={(times) => onChange({ ...step, times })}
      />
    </>
  );
}

function WaitFields({ step, number, onChange }: FieldsOf<'wait'>) {
  return (
    <>
      <span>{words.macros.addWait}</span>
      <Field
        label={words.macros.stepMs({ number })}
        value={step.waitMs}
        range={WAIT_MS}
        step={100}
        unit={words.servos.ms}
        onChange={(waitMs) => onChange({ ...step, waitMs })}
      />
    </>
  );
}

interface FieldProps {
  readonly label: string;
  readonly value: number;
  readonly range: Range;
  readonly step?: number;
  readonly unit?: string;
  onChange(value: number): void;
}

function Field({ range: { min, max }, ...field }: FieldProps) {
  const { notices } = useStores();
  return (
    <NumberField
      {...{ min, max, ...field }}
      onRefused={(value) => notices.refuse(words.refused({ name: field.label, value, min, max }))}
    />
  );
}
