// The page of buttons, in use or in edit mode. The kiosk shows the same page with nothing around it.

import { addMacro, moveMacro } from '#shared/profile/macroEdits.ts';
import type { Macro } from '#shared/profile/macro.ts';
import { useStores, useMacros, useView } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { runByKey } from '../../ui/action.ts';
import { useCards, useDragOrder, type DragOrder } from '../../ui/cards.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { Icon } from '../../ui/Icon.tsx';
import { MACRO_ACTIONS } from './macroActions.ts';
import { nameAndKey, MacroFace, MacroGrid } from './MacroGrid.tsx';
import { EmptyState, type EmptyStateProps, Panel } from '../../ui/Panel.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { MacroEditor } from './MacroEditor.tsx';
import styles from './Macros.module.css';

/** Adds a button at the end of the page and selects it. */
function useAddMacro(): () => void {
  const { macros, view } = useStores();
  return () => {
    const { nextId } = macros.store.getState().present;
    const name = words.macros.newName({ number: nextId });
    macros.edit(
      () => words.macros.edits.add({ name }),
      (page) => addMacro(page, name, []),
    );
    view.setState({ selectedButton: nextId, editsButtons: true });
  };
}

/** The buttons in edit mode: a press selects, a drag or Alt with an arrow moves. Nothing starts. */
function EditGrid() {
  const stores = useStores();
  const add = useAddMacro();
  const list = useMacros(({ present }) => present.macros);
  const selected = useView((state) => state.selectedButton);
  const {
    list: gridRef,
    tabStop,
    key,
  } = useCards<HTMLUListElement>({
    ...{ ids: list.map(({ id }) => id), selected, attribute: 'data-macro' },
    select: (id) => stores.view.setState({ selectedButton: id }),
    act: (pressed, id) => runByKey(Object.values(MACRO_ACTIONS), pressed, { stores, id }),
  });

  return (
    <ul ref={gridRef} className={styles.grid} aria-label={words.macros.list} onKeyDown={key}>
      {list.map((macro) => (
        <EditCard
          key={macro.id}
          macro={macro}
          isSelected={macro.id === selected}
          isTabStop={macro.id === tabStop}
        />
      ))}
      <li className={styles.add}>
        <Button icon="plus" wide onPress={add}>
          {words.macros.add}
        </Button>
      </li>
    </ul>
  );
}

interface EditCardProps {
  readonly macro: Macro;
  readonly isSelected: boolean;
  readonly isTabStop: boolean;
}

function EditCard({ macro, isSelected, isTabStop }: EditCardProps) {
  const { view } = useStores();
  const { isDragged, startDrag } = useMacroDrag(macro);
  return (
    <li data-macro={macro.id} className={cx(styles.card, isDragged && styles.dragged)}>
      <button
        type="button"
        data-card-face=""
        className={styles.button}
        data-colour={macro.colour}
        aria-label={nameAndKey(macro)}
        aria-pressed={isSelected}
        tabIndex={isTabStop ? 0 : -1}
        onClick={() => view.setState({ selectedButton: macro.id })}
      >
        <MacroFace macro={macro} progress={null} />
      </button>
      <span className={styles.grip} aria-hidden="true" onPointerDown={startDrag}>
        <Icon name="grip" />
      </span>
    </li>
  );
}

function useMacroDrag({ id, name }: Macro): DragOrder {
  const { macros, view } = useStores();
  return useDragOrder({
    attribute: 'data-macro',
    begin() {
      macros.begin(() => words.macros.edits.move({ name }));
      view.setState({ selectedButton: id });
    },
    over(other) {
      const to = macros.store.getState().present.macros.findIndex((macro) => macro.id === other);
      if (to >= 0) macros.preview((page) => moveMacro(page, id, to));
    },
    commit: () => macros.commit(),
    cancel: () => macros.cancel(),
  });
}

export function ButtonsPage() {
  const edits = useView((state) => state.editsButtons);
  const isEmpty = useMacros(({ present }) => present.macros.length === 0);
  return (
    <div className={styles.page} data-edits={edits}>
      <Panel title={words.macros.title} tools={<Tools />} className={styles.panel}>
        {edits ? <EditGrid /> : isEmpty ? <NoButtons action={<Add />} /> : <MacroGrid />}
        <Foot />
      </Panel>
      {edits && <MacroEditor />}
    </div>
  );
}

export function NoButtons({ action }: Pick<EmptyStateProps, 'action'>) {
  return <EmptyState title={words.macros.noButtons} hint={words.macros.noButtonsHint} action={action} />;
}

function Add() {
  return (
    <Button icon="plus" onPress={useAddMacro()}>
      {words.macros.add}
    </Button>
  );
}

function Tools() {
  const { macros, macroRun, view } = useStores();
  const edits = useView((state) => state.editsButtons);
  return (
    <>
      <Toggle
        label={words.macros.edit}
        isOn={edits}
        onChange={(isOn) => {
          macroRun.end();
          view.setState({ editsButtons: isOn });
        }}
      />
      <UndoTools of={macros} />
    </>
  );
}

function Foot() {
  const { view } = useStores();
  return (
    <div className={styles.foot}>
      <Button icon="kiosk" onPress={() => view.setState({ kiosk: 'on', editsButtons: false })}>
        {words.macros.kiosk}
      </Button>
      <p className={styles.hint}>{words.macros.kioskHint}</p>
    </div>
  );
}
