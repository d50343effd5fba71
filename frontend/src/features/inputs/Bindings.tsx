// The list of bindings: a row per servo with its keys and sticks, highlighted while they are held. For a new binding, press the input,
// then fill in the form.

import type { Label } from '#shared/document/history.ts';
import { useEffect, useRef, useState } from 'react';
import { type Binding, type Input, isOfTip, valueOf } from '#shared/profile/mapping.ts';
import { shaped } from '#shared/profile/mappingStep.ts';
import { useMapping, usePoses, useRobot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { pressOnce } from '../../ui/inputEvents.ts';
import { inputName, chipText, readyBindings, rowsOf } from './rows.ts';
import { words } from '../../i18n/whole.ts';
import { BindingForm, draftFor, draftOf, type Draft } from './BindingForm.tsx';
import styles from './Bindings.module.css';

export function Bindings() {
  const { mappings } = useStores();
  const robot = useRobot();
  const mapping = useMapping();
  const [draft, setDraft] = useState<Draft | null>(null);

  const edit = (label: Label, bindings: readonly Binding[]): void => {
    mappings.edit(label, (former) => ({ ...former, bindings }));
    setDraft(null);
  };
  const save = (binding: Binding, at: number | null): void => {
    const { bindings } = mapping;
    const label = (): string => words.pad.steps.bind({ input: inputName(binding.input) });
    edit(label, at === null ? [...bindings, binding] : bindings.with(at, binding));
  };
  const remove = (at: number): void => {
    const gone = mapping.bindings[at];
    if (gone === undefined) return;
    edit(() => words.pad.steps.unbind({ input: inputName(gone.input) }), mapping.bindings.toSpliced(at, 1));
  };

  return (
    <div className={styles.bindings}>
      <div className={styles.tools}>
        <Listen onHeard={(input) => setDraft(draftFor(input, robot))} />
        <Button
          tone="quiet"
          hint={words.pad.readyHint}
          onPress={() => edit(() => words.pad.steps.ready, readyBindings(robot, isOfTip(mapping)))}
        >
          {words.pad.ready}
        </Button>
      </div>
      {draft !== null && (
        <BindingForm
          key={`${draft.at} ${inputName(draft.input)}`}
          initial={draft}
          onSave={save}
          onRemove={remove}
          onCancel={() => setDraft(null)}
        />
      )}
      <Table onEdit={(at, binding) => setDraft(draftOf(at, binding, robot))} />
    </div>
  );
}

/** Waits for the next input that is moved. */
function Listen({ onHeard }: { onHeard(input: Input): void }) {
  const { pad } = useStores();
  const [giveUp, setGiveUp] = useState<(() => void) | null>(null);
  useEffect(() => giveUp ?? undefined, [giveUp]);

  function listen(): void {
    const stop = pad.listen((input) => {
      setGiveUp(null);
      onHeard(input);
    });
    setGiveUp(() => stop);
  }

  if (giveUp === null)
    return (
      <Button tone="primary" icon="plus" hint={words.pad.addHint} onPress={listen}>
        {words.pad.add}
      </Button>
    );
  return (
    <div
      className={styles.listening}
      onKeyDown={({ key }) => {
        if (key === 'Escape') setGiveUp(null);
      }}
    >
      <p role="status">{words.pad.listening}</p>
      <Button autoFocus onPress={() => setGiveUp(null)}>
        {words.pad.giveUp}
      </Button>
    </div>
  );
}

function Table({ onEdit }: { onEdit(at: number, binding: Binding): void }) {
  const { pad } = useStores();
  const book = usePoses(({ present }) => present);
  const robot = useRobot();
  const mapping = useMapping();
  const list = useRef<HTMLUListElement>(null);

  useEachFrame(() => {
    const inputs = pad.inputs();
    for (const chip of list.current?.querySelectorAll<HTMLElement>('[data-binding]') ?? []) {
      const binding = mapping.bindings[Number(chip.dataset.binding)];
      const isHeld = binding !== undefined && shaped(valueOf(binding.input, inputs), mapping.feel) !== 0;
      chip.dataset.held = String(isHeld);
    }
  });

  return (
    <ul ref={list} className={styles.rows} aria-label={words.pad.table}>
      {rowsOf(mapping, robot, book).map(({ id, title, bindings }) => (
        <li key={id} className={styles.row}>
          <span className={styles.title}>{title}</span>
          <span className={styles.chips}>
            {bindings.length === 0 && <span className={styles.none}>{words.pad.none}</span>}
            {bindings.map((at) => {
              const binding = mapping.bindings[at];
              return (
                binding && (
                  <button
                    key={at}
                    type="button"
                    data-binding={at}
                    className={styles.chip}
                    aria-label={words.pad.edit({ input: inputName(binding.input), row: title })}
                    onClick={() => onEdit(at, binding)}
                    onKeyDown={pressOnce}
                  >
                    {chipText(binding)}
                  </button>
                )
              );
            })}
          </span>
        </li>
      ))}
    </ul>
  );
}
