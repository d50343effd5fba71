// What can be done with the selected frame, in words. Always in its place, so that nothing jumps when a frame is selected.

import { duplicateFrame, indexOfFrame, moveFrame, setTargets } from '#shared/actions/group/groupEdits.ts';
import { motionHindrance } from '../stores/readiness.ts';
import { GENTLE_MOVE_MS } from '../stores/moveTime.ts';
import { useDevice, useDocument, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { Button, IconButton } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { useWholeFrames } from '../timeline/wholeFrames.ts';
import { captureFrame } from './capture.ts';
import { useKnowsPose } from './CaptureButton.tsx';
import { deleteFrames, together } from './deleteFrames.ts';
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
  const whole = together(useWholeFrames(), id);
  const several = whole.length > 1;
  const none = index < 0;
  /** These are about one frame. */
  const notOne = none || several;

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
    const stays = (frame: { readonly id: number }): boolean => !whole.includes(frame.id);
    const next = frames.slice(index).find(stays) ?? frames.slice(0, index).findLast(stays);
    view.setState({ selectedFrame: next?.id ?? null });
    deleteFrames(document, whole);
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
      <span className={styles.which}>
        {none
          ? words.actions.select
          : several
            ? words.actions.several(whole.length)
            : words.actions.frame(index + 1)}
      </span>
      <Button tone="quiet" icon="pose" isDisabled={notOne || !mayMove || !sameUnit} onPress={load}>
        {words.actions.load}
      </Button>
      <Button tone="quiet" icon="update" isDisabled={notOne || !knowsPose || !sameUnit} onPress={update}>
        {words.actions.update}
      </Button>
      <span className={styles.icons}>
        {INSERTS.map(([side, icon]) => (
          <IconButton
            key={side}
            icon={icon}
            label={words.actions.insert[side]}
            isDisabled={notOne || !knowsPose || !sameUnit}
            onPress={() => captureFrame(stores, side)}
          />
        ))}
        <IconButton
          icon="earlier"
          label={words.actions.earlier}
          isDisabled={notOne || index === 0}
          onPress={move(index - 1)}
        />
        <IconButton
          icon="later"
          label={words.actions.later}
          isDisabled={notOne || index === count - 1}
          onPress={move(index + 1)}
        />
        <IconButton icon="copy" label={words.actions.duplicate} isDisabled={notOne} onPress={duplicate} />
        <IconButton icon="trash" label={words.actions.delete} isDisabled={none} onPress={remove} />
      </span>
    </div>
  );
}
