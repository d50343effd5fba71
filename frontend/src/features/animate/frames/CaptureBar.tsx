// How frames come into the group: the pose captured, a recording, an example. And how long the group is.

import { totalDurationMs } from '#shared/group/group.ts';
import { ExamplesControl } from '../group/ExamplesControl.tsx';
import { RecordControl } from '../play/RecordControl.tsx';
import { useDocument, useStores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { captureFrame } from './capture.ts';
import { CaptureButton } from './CaptureButton.tsx';
import styles from './CaptureBar.module.css';

export function CaptureBar() {
  const stores = useStores();
  return (
    <div className={styles.bar}>
      <CaptureButton
        label={words.actions.capture}
        hint={words.actions.captureHint}
        onPress={() => captureFrame(stores, 'after')}
      />
      <RecordControl />
      <ExamplesControl />
      <Total />
    </div>
  );
}

function Total() {
  const count = useDocument(({ present }) => present.frames.length);
  const totalMs = useDocument(({ present }) => totalDurationMs(present.frames));
  return <p className={styles.total}>{count === 0 ? '' : words.actions.total({ count, ms: totalMs })}</p>;
}
