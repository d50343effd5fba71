// The steps of a button, one row each, and three ways to add one.

import type { Macro, MacroStep } from '#shared/profile/macro.ts';
import { addStep, moveStep, removeStep, setStep } from '#shared/profile/macroEdits.ts';
import type { MacroPage } from '#shared/profile/macro.ts';
import { GENTLE_MOVE_MS } from '../../robot/moveTime.ts';
import { useStores } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { StepFields } from './StepFields.tsx';
import styles from './MacroEditor.module.css';

const NEW_STEPS = {
  addPose: { kind: 'pose', pose: 'home', durationMs: GENTLE_MOVE_MS },
  addSlot: { kind: 'slot', slot: 0, times: 1 },
  addWait: { kind: 'wait', waitMs: 1000 },
} as const satisfies Readonly<Record<string, MacroStep>>;
const ADD_STEPS = ['addPose', 'addSlot', 'addWait'] as const;

export function StepList({ macro: { id, name, steps } }: { readonly macro: Macro }) {
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
