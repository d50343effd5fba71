// Beside the sliders of a phone, where the action group and the poses are a tab away: the current pose as the next frame or
// as a pose, in one press. Says what was captured and offers to take it back.

import { useIsUnidentified, useStores, type Stores } from '../features/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../i18n/words.ts';
import type { Undoable } from '../state/store.ts';
import { captureFrame, useKnowsPose, useUnknownText } from '../features/animate/frames/CaptureButton.tsx';
import styles from './CaptureStrip.module.css';

export function CaptureStrip() {
  const stores = useStores();
  const isKnown = useKnowsPose();
  const unknown = useUnknownText();
  if (useIsUnidentified()) return null;
  return (
    <section className={styles.strip} aria-label={words.actions.captureHere}>
      {isKnown ? <Captures stores={stores} /> : <p className={styles.hint}>{unknown}</p>}
    </section>
  );
}

function Captures({ stores }: { readonly stores: Stores }) {
  const { document, poses, notices } = stores;

  const frame = (): void => {
    captureFrame(stores, 'end');
    const { frames } = document.store.getState().present;
    tell(words.actions.captured({ number: frames.length }), document);
  };
  const pose = (): void => tell(words.poses.captured({ name: poses.capture() }), poses.book);

  /** What was written on top meanwhile is not taken back. */
  function tell(text: string, where: Pick<Undoable<unknown>, 'store' | 'undo'>): void {
    const { present } = where.store.getState();
    const undo = (): void => {
      if (where.store.getState().present === present) where.undo();
    };
    notices.show('info', text, { label: words.actions.undo, act: undo });
  }

  return (
    <>
      <Button wide tone="primary" icon="plus" hint={words.actions.captureEndHint} onPress={frame}>
        {words.actions.capture}
      </Button>
      <Button wide icon="plus" hint={words.poses.captureHint} onPress={pose}>
        {words.poses.capture}
      </Button>
    </>
  );
}
