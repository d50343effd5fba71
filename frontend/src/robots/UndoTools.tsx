// Undo and redo of what is done to robots, named by what they take back.

import { useStore } from 'zustand';
import { redoLabel, undoLabel } from '#shared/actions/history.ts';
import { useStores } from '../stores/stores.ts';
import { IconButton } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import styles from './RobotDialog.module.css';

export function UndoTools() {
  const { robots } = useStores();
  const undo = useStore(robots.store, undoLabel);
  const redo = useStore(robots.store, redoLabel);
  return (
    <div className={styles.undo}>
      <IconButton
        icon="undo"
        label={undo === null ? words.robots.undoVerb : words.robots.undo(undo)}
        isDisabled={undo === null}
        onPress={robots.undo}
      />
      <IconButton
        icon="redo"
        label={redo === null ? words.robots.redoVerb : words.robots.redo(redo)}
        isDisabled={redo === null}
        onPress={robots.redo}
      />
    </div>
  );
}
