// The page of buttons: in use by anybody, or being changed. The kiosk is the same page with nothing around it.

import { useMacros, useStores, useView } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { EmptyState, type EmptyStateProps } from '../../ui/EmptyState.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { words } from '../../i18n/whole.ts';
import { EditGrid } from './EditGrid.tsx';
import { MacroEditor } from './MacroEditor.tsx';
import { MacroGrid } from './MacroGrid.tsx';
import styles from './Macros.module.css';
import { useAddMacro } from './useAddMacro.ts';

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
