// The way back to all robots, and undo: above the description and above the calibration.

import { useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { UndoTools } from '../undo/UndoTools.tsx';
import dialog from './RobotDialog.module.css';
import styles from './RobotEditor.module.css';

export function RobotHead() {
  const { view, robots } = useStores();
  return (
    <div className={styles.head}>
      <Button tone="quiet" icon="earlier" onPress={() => view.setState({ robotView: 'list' })}>
        {words.robots.back}
      </Button>
      <div className={dialog.undo}>
        <UndoTools of={robots} />
      </div>
    </div>
  );
}
