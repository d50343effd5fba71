// What can be done with the selected frames, in words. Always in its place, so that nothing jumps when a frame is selected.

import { indexOfFrame, setTargets } from '#shared/group/groupEdits.ts';
import { freeOf, stayingOf } from '../../servoView.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moveTime.ts';
import { useDevice, useDocument, useSnapshot, useStores, useTimeline, useView } from '../../stores.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { words } from '../../../i18n/whole.ts';
import { AddsSwitch } from '../timeline/TimelineTools.tsx';
import { useWholeFrames } from '../timeline/wholeFrames.ts';
import { captureFrame } from './capture.ts';
import { useKnowsPose } from './CaptureStrip.tsx';
import { copy, cut, duplicate, moveBy, paste, removeFrames, together, type FrameIds } from './frameVerbs.ts';
import styles from './FrameTools.module.css';

const INSERTS = [
  ['before', 'insertBefore'],
  ['after', 'insertAfter'],
] as const;

export function FrameTools() {
  const stores = useStores();
  const { device, document, notices } = stores;
  const id = useView((state) => state.selectedFrame) ?? -1;
  const index = useDocument(({ present }) => indexOfFrame(present, id));
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
    if (frame === undefined) return;
    const free = freeOf(stores, frame.targets);
    const staying = stayingOf(stores, frame.targets);
    if (free.length > 0) device.move(free, Math.max(frame.durationMs, GENTLE_MOVE_MS));
    if (staying !== null) notices.tell('info', staying);
  };
  const update = (): void =>
    document.edit(
      () => words.actions.steps.update({ number: index + 1 }),
      (before) => setTargets(before, id, device.pose()),
    );
  return (
    <div className={styles.tools} role="group" aria-label={words.actions.tools}>
      <span className={styles.which}>
        {none
          ? words.actions.select
          : several
            ? words.actions.several({ count: whole.length })
            : words.actions.frame({ number: index + 1 })}
      </span>
      <AddsSwitch />
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
        <OrderButtons ids={none ? [] : whole} />
      </span>
      <span className={styles.icons}>
        <ClipButtons ids={none ? [] : whole} />
        <IconButton
          icon="trash"
          label={words.actions.delete}
          isDisabled={none}
          onPress={() => removeFrames(stores, whole)}
        />
      </span>
    </div>
  );
}

interface OfFrames {
  readonly ids: FrameIds;
}

function OrderButtons({ ids }: OfFrames) {
  const stores = useStores();
  const isAtStart = useDocument(({ present }) => ids.includes(present.frames[0]?.id ?? -1));
  const isAtEnd = useDocument(({ present }) => ids.includes(present.frames.at(-1)?.id ?? -1));
  const [id] = ids;
  const move = (places: number) => (): void => {
    if (id !== undefined) moveBy(stores, id, places);
  };
  return (
    <>
      <IconButton
        icon="earlier"
        label={words.actions.earlier}
        isDisabled={id === undefined || isAtStart}
        onPress={move(-1)}
      />
      <IconButton
        icon="later"
        label={words.actions.later}
        isDisabled={id === undefined || isAtEnd}
        onPress={move(1)}
      />
      <IconButton
        icon="duplicate"
        label={words.actions.duplicate}
        isDisabled={id === undefined}
        onPress={() => duplicate(stores, ids)}
      />
    </>
  );
}

function ClipButtons({ ids }: OfFrames) {
  const stores = useStores();
  const hasClip = useTimeline(({ clip }) => clip !== null);
  const none = ids.length === 0;
  return (
    <>
      <IconButton
        icon="cut"
        label={words.actions.cut}
        isDisabled={none}
        onPress={() => void cut(stores, ids)}
      />
      <IconButton
        icon="copy"
        label={words.actions.copy}
        isDisabled={none}
        onPress={() => void copy(stores, ids)}
      />
      <IconButton
        icon="paste"
        label={words.actions.paste}
        isDisabled={!hasClip}
        onPress={() => paste(stores, stores.timeline.getState().clip)}
      />
    </>
  );
}
