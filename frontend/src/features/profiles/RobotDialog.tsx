// The dialog of robots: their list, the editor of the current one, and its calibration. Ctrl+Z applies to robots here, not to the frames
// behind the dialog. Also the button that opens it.

import type { ComponentType } from 'react';
import { useRobot, useStores, useView } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { pressOnce } from '../../ui/inputEvents.ts';
import { words } from '../../i18n/words.ts';
import { UNDO_ACTIONS } from '../undo/UndoTools.tsx';
import { runByKey } from '../../ui/action.ts';
import type { ViewState } from '../view.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import styles from './RobotDialog.module.css';

/** Shows the current robot's name in the top bar and opens the list of robots. */
export function RobotButton() {
  const { view } = useStores();
  const { name } = useRobot();
  return (
    <button
      type="button"
      className={styles.button}
      aria-label={words.robots.button({ name })}
      aria-haspopup="dialog"
      onClick={() => view.setState({ robotView: 'list' })}
      onKeyDown={pressOnce}
    >
      <span className={styles.icon}>
        <Icon name="pose" />
      </span>
      <span className={styles.name}>{name}</span>
      <Icon name="down" />
    </button>
  );
}

type RobotView = NonNullable<ViewState['robotView']>;

export function RobotDialog() {
  const { view, robots } = useStores();
  const open = useView((state) => state.robotView);
  const Content = open === null ? null : CONTENT[open];
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
          if (!runByKey(UNDO_ACTIONS, event, robots)) return;
          event.preventDefault();
          event.stopPropagation();
        }}
      >
        {Content !== null && <Content />}
      </div>
    </Dialog>
  );
}

const CONTENT: Readonly<Record<RobotView, ComponentType>> = {
  list: laterComponent(async () => (await import('./RobotList.tsx')).RobotList, '50vh'),
  edit: laterComponent(async () => (await import('./RobotEditor.tsx')).RobotEditor, '50vh'),
  calibrate: laterComponent(
    async () => (await import('./calibration/CalibrationWizard.tsx')).CalibrationWizard,
    '50vh',
  ),
};
