// What can be done with the selected frame, in words. Always in its place, so that nothing jumps when a frame is selected.

import {
  deleteFrame,
  duplicateFrame,
  indexOfFrame,
  moveFrame,
  setTargets,
} from '#shared/actions/group/groupEdits.ts';
import { motionHindrance } from '../stores/readiness.ts';
import { GENTLE_MOVE_MS } from '../stores/moveTime.ts';
import { useDevice, useDocument, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { Button, IconButton } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { captureFrame } from './capture.ts';
import { useKnowsPose } from './CaptureButton.tsx';
import { commandedPose } from './pose.ts';
import styles from './FrameTools.module.css';

const INSERTS = [
  ['before', 'insertBefore'],
  ['after', 'insertAfter'],
] as const;

export function FrameTools() {
  const stores = useStores();
  const { device, document, view } = stores;
  const id = useView((state) => state.selectedFrame) ?? -1;
  const index = useDocument(({ present }) => indexOfFrame(present, id));
  const count = useDocument(({ present }) => present.frames.length);
  const unit = useDocument(({ present }) => present.unit);
  const knowsPose = useKnowsPose();
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const none = index < 0;

  const load = (): void => {
    const frame = document.store.getState().present.frames[index];
    if (frame !== undefined) device.move(frame.targets, Math.max(frame.durationMs, GENTLE_MOVE_MS));
  };
  const update = (): void =>
    document.edit(
      () => words.actions.steps.update(index + 1),
      (before) => setTargets(before, id, commandedPose(device.store.getState().targets)),
    );
  const move = (to: number) => (): void => {
    document.edit(
      () => words.actions.steps.move(index + 1),
      (before) => moveFrame(before, id, to),
    );
    view.setState({ said: words.actions.moved(index + 1, to + 1) });
  };
  const remove = (): void => {
    const { frames } = document.store.getState().present;
    view.setState({ selectedFrame: frames[index + 1]?.id ?? frames[index - 1]?.id ?? null });
    document.edit(
      () => words.actions.steps.delete(index + 1),
      (before) => deleteFrame(before, id),
    );
  };
  const duplicate = (): void => {
    view.setState({ selectedFrame: document.store.getState().present.nextId });
    document.edit(
      () => words.actions.steps.duplicate(index + 1),
      (before) => duplicateFrame(before, id),
    );
  };

  return (
    <div className={styles.tools} role="group" aria-label={words.actions.tools}>
      <span className={styles.which}>{none ? words.actions.select : words.actions.frame(index + 1)}</span>
      <Button tone="quiet" icon="pose" isDisabled={none || !mayMove || !sameUnit} onPress={load}>
        {words.actions.load}
      </Button>
      <Button tone="quiet" icon="update" isDisabled={none || !knowsPose || !sameUnit} onPress={update}>
        {words.actions.update}
      </Button>
      <span className={styles.icons}>
        {INSERTS.map(([side, icon]) => (
          <IconButton
            key={side}
            icon={icon}
            label={words.actions.insert[side]}
            isDisabled={none || !knowsPose || !sameUnit}
            onPress={() => captureFrame(stores, side)}
          />
        ))}
        <IconButton
          icon="earlier"
          label={words.actions.earlier}
          isDisabled={none || index === 0}
          onPress={move(index - 1)}
        />
        <IconButton
          icon="later"
          label={words.actions.later}
          isDisabled={none || index === count - 1}
          onPress={move(index + 1)}
        />
        <IconButton icon="copy" label={words.actions.duplicate} isDisabled={none} onPress={duplicate} />
        <IconButton icon="trash" label={words.actions.delete} isDisabled={none} onPress={remove} />
      </span>
    </div>
  );
}
