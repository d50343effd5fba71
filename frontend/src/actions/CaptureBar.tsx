// The foot of the action group: capture the pose as a frame, the group's length, and playing it.

import { ExamplesControl } from '../examples/ExamplesControl.tsx';
import { PlayBar } from '../play/PlayBar.tsx';
import { RecordControl } from '../record/RecordControl.tsx';
import { useGroup, useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { captureFrame } from './capture.ts';
import { CaptureButton } from './CaptureButton.tsx';
import styles from './CaptureBar.module.css';

export function CaptureBar({ totalMs }: { readonly totalMs: number }) {
  const stores = useStores();
  const count = useGroup().frames.length;
  return (
    <>
      <div className={styles.bar}>
        <CaptureButton
          label={words.actions.capture}
          hint={words.actions.captureHint}
          onPress={() => captureFrame(stores, 'after')}
        />
        <RecordControl />
        <ExamplesControl />
        <p className={styles.total}>{count === 0 ? '' : words.actions.total(count, totalMs)}</p>
      </div>
      <PlayBar />
    </>
  );
}
