// Everything about robots in one dialog: the list of them, the description of the one at hand, its calibration. Ctrl+Z here
// is the robots' own, not that of the frames behind the dialog.

import type { ReactNode } from 'react';
import { undoActionOf } from '../actions/useUndoKeys.ts';
import { CalibrationWizard } from '../calibration/CalibrationWizard.tsx';
import { useStores, useView } from '../stores/stores.ts';
import type { ViewState } from '../stores/view.ts';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/words.ts';
import { RobotEditor } from './RobotEditor.tsx';
import { RobotList } from './RobotList.tsx';
import styles from './RobotDialog.module.css';

type RobotView = NonNullable<ViewState['robotView']>;

export function RobotDialog() {
  const { view, robots } = useStores();
  const open = useView((state) => state.robotView);
  return (
    <Dialog
      full={open === 'edit'}
      wide={open !== 'edit'}
      title={words.robots.title}
      closeLabel={words.close}
      isOpen={open !== null}
      onClose={() => view.setState({ robotView: null })}
    >
      <div
        className={styles.content}
        onKeyDown={(event) => {
          const action = undoActionOf(event);
          if (action === null) return;
          event.preventDefault();
          event.stopPropagation();
          robots[action]();
        }}
      >
        {open !== null && CONTENT[open]}
      </div>
    </Dialog>
  );
}

const CONTENT: Readonly<Record<RobotView, ReactNode>> = {
  list: <RobotList />,
  edit: <RobotEditor />,
  calibrate: <CalibrationWizard />,
};
