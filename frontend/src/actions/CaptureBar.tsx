// The foot of the action group: capture the pose as a frame, the group's length, and playing it.

import { indexOfFrame, insertFrame } from '#shared/actions/group/groupEdits.ts';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { ServoTarget } from '#shared/protocol/commands.ts';
import { ExamplesControl } from '../examples/ExamplesControl.tsx';
import { PlayBar } from '../play/PlayBar.tsx';
import { RecordControl } from '../record/RecordControl.tsx';
import { useDevice, useGroup, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { commandedPose } from './pose.ts';
import styles from './CaptureBar.module.css';

const USUAL_FRAME_MS = 1000;

export function CaptureBar({ totalMs }: { readonly totalMs: number }) {
  const count = useGroup().frames.length;
  return (
    <>
      <div className={styles.bar}>
        <Capture />
        <RecordControl />
        <ExamplesControl />
        <p className={styles.total}>{count === 0 ? '' : words.actions.total(count, totalMs)}</p>
      </div>
      <PlayBar />
    </>
  );
}

function Capture() {
  const { device, document, view } = useStores();
  const isKnown = useDevice((state) => Object.keys(state.targets).length > 0);
  const capture = (): void => {
    const { targets, family } = device.store.getState();
    const { nextId } = document.store.getState().present;
    const { selectedFrame } = view.getState();
    document.edit(
      () => words.actions.steps.capture,
      (group) => captured(group, selectedFrame, commandedPose(targets), family.unit),
    );
    view.setState({ selectedFrame: nextId });
  };
  return (
    <>
      <Button
        tone="primary"
        icon="plus"
        hint={words.actions.captureHint}
        isDisabled={!isKnown}
        onPress={capture}
      >
        {words.actions.capture}
      </Button>
      {!isKnown && <p className={styles.hint}>{words.actions.nothingKnown}</p>}
    </>
  );
}

/** Behind the selected frame, or at the end; as long as the frame before it. */
function captured(
  group: ActionGroup,
  selected: number | null,
  targets: readonly ServoTarget[],
  unit: ActionGroup['unit'],
): ActionGroup {
  const at = selected === null ? -1 : indexOfFrame(group, selected);
  const index = at < 0 ? group.frames.length : at + 1;
  const durationMs = group.frames[index - 1]?.durationMs ?? USUAL_FRAME_MS;
  return insertFrame(group, index, { durationMs, targets }, unit);
}
