// The editor of the selected button: its name, colour, key and steps, each with its own fields.

import { useId, useState, type KeyboardEvent } from 'react';
import {
  type Macro,
  type MacroStep,
  type MacroPage,
  macroOf,
  SLOT,
  SLOT_TIMES,
  WAIT_MS,
} from '#shared/profile/macro.ts';
import { addStep, moveStep, removeStep, setStep, changeMacro } from '#shared/profile/macroEdits.ts';
import { COLOURS } from '#shared/document/schema.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { useStores, useMacros, useView } from '../stores.ts';
import { Button, IconButton, ActionIconButton } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { NameField } from '../../ui/NameField.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { MACRO_ACTIONS, macroContextOf, type MacroContext } from './macroActions.ts';
import { macroKey } from './MacroGrid.tsx';
import styles from './MacroEditor.module.css';
import { POSE_MS } from '#shared/profile/pose.ts';
import { PoseSelect } from '../poses/PoseSelect.tsx';
import { CheckedNumber } from '../CheckedNumber.tsx';

const NEW_STEPS = {
  addPose: { kind: 'pose', pose: 'home', durationMs: GENTLE_MOVE_MS },
  addSlot: { kind: 'slot', slot: 0, times: 1 },
  addWait: { kind: 'wait', waitMs: 1000 },
} as const satisfies Readonly<Record<string, MacroStep>>;
const ADD_STEPS = ['addPose', 'addSlot', 'addWait'] as const;

function StepList({ macro: { id, name, steps } }: { readonly macro: Macro }) {
  const { macros } = useStores();
  const edit = (change: (page: MacroPage) => MacroPage): void =>
    macros.edit(() => words.macros.edits.steps({ name }), change);
  return (
    <>
      <ol className={styles.list} aria-label={words.macros.steps}>
        {steps.map((step, index) => (
          <li key={index} className={styles.step}>
            <span className={styles.number}>{index + 1}</span>
            <StepFields
              step={step}
              number={index + 1}
              onChange={(next) => edit((page) => setStep(page, id, index, next))}
            />
            <span className={styles.order}>
              <IconButton
                icon="up"
                label={words.macros.stepUp({ number: index + 1 })}
                isDisabled={index === 0}
                onPress={() => edit((page) => moveStep(page, id, index, index - 1))}
              />
              <IconButton
                icon="down"
                label={words.macros.stepDown({ number: index + 1 })}
                isDisabled={index === steps.length - 1}
                onPress={() => edit((page) => moveStep(page, id, index, index + 1))}
              />
              <IconButton
                icon="trash"
                label={words.macros.stepDelete({ number: index + 1 })}
                onPress={() => edit((page) => removeStep(page, id, index))}
              />
            </span>
          </li>
        ))}
      </ol>
      {steps.length === 0 && <p className={styles.hint}>{words.macros.empty}</p>}
      <div className={styles.row} role="group" aria-label={words.macros.addStep}>
        <span className={styles.label}>{words.macros.addStep}</span>
        {ADD_STEPS.map((verb) => (
          <Button key={verb} icon="plus" onPress={() => edit((page) => addStep(page, id, NEW_STEPS[verb]))}>
            {words.macros[verb]}
          </Button>
        ))}
      </div>
    </>
  );
}

export function MacroEditor() {
  const id = useView((state) => state.selectedButton);
  const macro = useMacros(({ present }) => macroOf(present, id));
  if (macro === undefined) return <p className={styles.hint}>{words.macros.select}</p>;
  return (
    <Panel
      title={words.macros.selected({ name: macro.name })}
      tools={<Tools macro={macro} />}
      className={styles.panel}
    >
      <div className={styles.fields}>
        <Name macro={macro} />
        <Colours macro={macro} />
        <KeyField key={macro.id} macro={macro} />
        <StepList macro={macro} />
      </div>
    </Panel>
  );
}

interface MacroProps {
  readonly macro: Macro;
}

function Tools({ macro }: MacroProps) {
  const stores = useStores();
  useMacros(({ present }) => present.macros);
  const context = (): MacroContext => macroContextOf(stores);
  return (['earlier', 'later', 'remove'] as const).map((name) => (
    <ActionIconButton
      key={name}
      action={MACRO_ACTIONS[name]}
      shown={{ stores, id: macro.id }}
      context={context}
    />
  ));
}

function Name({ macro: { id, name } }: MacroProps) {
  const { macros } = useStores();
  return (
    <NameField
      isFramed
      label={words.macros.name}
      name={name}
      onRename={(wanted) =>
        macros.edit(
          () => words.macros.edits.rename({ name }),
          (page) => changeMacro(page, id, { name: wanted }),
        )
      }
    />
  );
}

function Colours({ macro: { id, name, colour } }: MacroProps) {
  const { macros } = useStores();
  const group = useId();
  return (
    <fieldset className={styles.colours} aria-label={words.macros.colour}>
      {COLOURS.map((one) => (
        <label key={one} className={styles.colour} data-colour={one}>
          <input
            type="radio"
            name={group}
            aria-label={words.macros.colours[one]}
            checked={one === colour}
            onChange={() =>
              macros.edit(
                () => words.macros.edits.colour({ name }),
                (page) => changeMacro(page, id, { colour: one }),
              )
            }
          />
        </label>
      ))}
    </fieldset>
  );
}

/** Modifier keys: the field waits for the next key. */
const HELD_WITH_OTHERS = new Set(['Shift', 'Control', 'Alt', 'AltGraph', 'Meta']);

function KeyField({ macro: { id, name, key } }: MacroProps) {
  const { macros, notices } = useStores();
  const [isListening, setListening] = useState(false);
  const setKey = (wanted: string | null): void => {
    setListening(false);
    const { present } = macros.store.getState();
    const loser = present.macros.find((one) => wanted !== null && one.key === wanted && one.id !== id);
    macros.edit(
      () => words.macros.edits.key({ name }),
      (page) => changeMacro(page, id, { key: wanted }),
    );
    if (loser !== undefined && wanted !== null)
      notices.show('info', words.macros.keyTaken({ key: wanted.toUpperCase(), from: loser.name }));
  };
  /** Runs before the key presses the button. Esc, which is STOP as well, ends the waiting. */
  const listen = (event: KeyboardEvent): void => {
    if (!isListening || event.key === 'Tab') return;
    event.preventDefault();
    event.stopPropagation();
    const wanted = macroKey(event.nativeEvent);
    if (wanted !== null) setKey(wanted);
    else if (event.key === 'Escape') setListening(false);
    else if (!event.repeat && !HELD_WITH_OTHERS.has(event.key)) notices.show('info', words.macros.keyUnfit);
  };
  return (
    <div className={styles.row} onKeyDownCapture={listen} onBlur={() => setListening(false)}>
      <span className={styles.label}>{words.macros.key}</span>
      <Button onPress={() => setListening(true)}>
        {isListening ? words.macros.pressKey : (key?.toUpperCase() ?? words.macros.setKey)}
      </Button>
      {key !== null && <IconButton icon="close" label={words.macros.noKey} onPress={() => setKey(null)} />}
    </div>
  );
}

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
      <CheckedNumber
        label={words.macros.stepMs({ number })}
        value={step.durationMs}
        {...POSE_MS}
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
        <CheckedNumber
          label={words.macros.stepSlot({ number })}
          value={step.slot}
          {...SLOT}
          onChange={(slot) => onChange({ ...step, slot })}
        />
      </span>
      <CheckedNumber
        label={words.macros.stepTimes({ number })}
        value={step.times}
        {...SLOT_TIMES}
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
      <CheckedNumber
        label={words.macros.stepMs({ number })}
        value={step.waitMs}
        {...WAIT_MS}
        step={100}
        unit={words.servos.ms}
        onChange={(waitMs) => onChange({ ...step, waitMs })}
      />
    </>
  );
}
