// The action group being written: its name, what plays it, its keys over time, its frames, and what can be done with them. A phone shows
// the frames first, and what begins one right below them. Edits go to the document alone; the robot moves only by Play and by loading a
// pose.

import { Fragment } from 'react';
import { motionLengthMs } from '#shared/group/blocks.ts';
import { indexOfFrame, rename } from '#shared/group/groupEdits.ts';
import { convertGroup } from '#shared/group/frameEdits.ts';
import {
  useDevice,
  useDocument,
  useGroupBoard,
  useHoldsMotion,
  useKnownFamily,
  useSnapshot,
  useStores,
  useTimeline,
  useView,
} from '../../stores.ts';
import { IconButton, Button, ActionButton, ActionIconButton } from '../../../ui/Button.tsx';
import { words } from '../../../i18n/whole.ts';
import { filesText } from '../../library/files/fileText.ts';
import { useFiles } from '../../library/files/FilesArea.tsx';
import { ExamplesControl } from '../group/ExamplesControl.tsx';
import { RecordControl } from '../play/RecordControl.tsx';
import { CaptureButton, captureFrame, useKnowsPose } from './CaptureButton.tsx';
import { BodyPicture } from '../../picture/Body.tsx';
import { CameraView } from '../../drive/RobotPanel.tsx';
import { CameraSwitch, useServoLayout } from '../../drive/ServosPanel.tsx';
import { cx } from '../../../ui/cx.ts';
import { EmptyState, type PanelParts } from '../../../ui/Panel.tsx';
import { useIsPainted } from '../../../ui/useInFrame.ts';
import { useLayout } from '../../../ui/useLayout.ts';
import { NameField } from '../../../ui/NameField.tsx';
import { PlayBar } from '../play/PlayBar.tsx';
import { UndoTools } from '../../undo/UndoTools.tsx';
import { FrameStrip } from './FrameStrip.tsx';
import { Timeline } from '../timeline/Timeline.tsx';
import captureBarStyles from './CaptureBar.module.css';
import styles from './ActionsPanel.module.css';
import { motionHindrance } from '../../../robot/readiness.ts';
import { AddsSwitch } from '../timeline/TimelineTools.tsx';
import { together, useWholeFrames } from './frameVerbs.ts';
import { FRAME_ACTIONS, frameContextOf, type FrameContext } from './frameActions.ts';
import toolsStyles from './FrameTools.module.css';

// The way to the library, beside the name of the group that is open.

function LibraryButton() {
  const { view } = useStores();
  return (
    <IconButton
      icon="library"
      label={words.library.button}
      aria-haspopup="dialog"
      onPress={() => view.setState({ libraryOpen: true })}
    />
  );
}

// Opens the dialog about files, and says how many wait in it.

function FilesButton() {
  const { counts, show } = useFiles();
  return (
    <Button tone="quiet" icon="file" onPress={show}>
      {filesText(counts)}
    </Button>
  );
}

// How frames come into the group: the pose captured, a recording, an example. And how long the group is.

function CaptureBar() {
  const stores = useStores();
  return (
    <div className={captureBarStyles.bar}>
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
  const totalMs = useDocument(({ present }) => motionLengthMs(present));
  const holdsMotion = useHoldsMotion();
  return (
    <p className={captureBarStyles.total}>
      {!holdsMotion ? '' : words.actions.total({ count, ms: totalMs })}
    </p>
  );
}

export const actionsParts: PanelParts = {
  title: () => words.actions.title,
  Note,
  Tools,
  Content,
  className: styles.panel,
};

function Note() {
  const { document } = useStores();
  const name = useDocument(({ present }) => present.name);
  const call = (wanted: string): void =>
    document.edit(
      () => words.actions.steps.rename,
      (before) => rename(before, wanted),
    );
  return (
    <span className={styles.named}>
      <LibraryButton />
      <NameField label={words.actions.name} name={name} onRename={call} />
    </span>
  );
}

function Tools() {
  const { document } = useStores();
  return (
    <>
      <FilesButton />
      <UndoTools of={document} />
    </>
  );
}

function Content() {
  const hasFrames = useDocument(({ present }) => present.frames.length > 0);
  const holdsMotion = useHoldsMotion();
  const isPhone = useLayout() === 'phone';
  const isFolded = useView(({ frameCards }) => frameCards === 'folded') && !isPhone;
  const isPainted = useIsPainted();
  const timeline = <Timeline key="timeline" />;
  const capture = <CaptureBar key="capture" />;
  const tools = hasFrames ? <FrameTools key="tools" /> : null;
  const play = holdsMotion ? <PlayBar key="play" /> : null;
  const frames = (
    <Fragment key="frames">
      {hasFrames ? !isFolded && <FrameStrip /> : <Empty />}
      {isPhone ? (
        [capture, tools, play]
      ) : (
        <div className={styles.foot}>
          {tools}
          {capture}
        </div>
      )}
    </Fragment>
  );
  const first = isPhone ? frames : [play, timeline];
  const second = isPhone ? timeline : frames;
  return (
    <>
      <OtherBoard />
      {isPhone && <PhonePicture />}
      {first}
      {isPainted ? second : <div className={styles.rest} />}
    </>
  );
}

/** A camera where it stands above the sliders, too. */
function PhonePicture() {
  const isCamera = useServoLayout() === 'camera';
  return (
    <div className={cx(styles.body, isCamera && styles.camera)}>
      {isCamera ? <CameraView /> : <BodyPicture />}
      <CameraSwitch />
    </div>
  );
}

/** What was made for another board is drawn as it is; it can be played here once it is converted. */
function OtherBoard() {
  const { document, notices } = useStores();
  const { isOther } = useGroupBoard();
  const { unit } = useKnownFamily();
  if (!isOther) return null;
  const convert = (): void => {
    const converted = convertGroup(document.store.getState().present, unit);
    if (converted === null) notices.show('warning', words.actions.notConverted);
    else
      document.edit(
        () => words.actions.steps.convert,
        () => converted,
      );
  };
  return (
    <div className={styles.otherBoard} role="status">
      <p>{words.actions.otherBoard}</p>
      <Button hint={words.actions.convertHint({ to: unit })} onPress={convert}>
        {words.actions.convert}
      </Button>
    </div>
  );
}

function Empty() {
  const holdsMotion = useHoldsMotion();
  return (
    <EmptyState
      title={words.actions.empty}
      hint={holdsMotion ? words.actions.onlyBlocksHint : words.actions.emptyHint}
      sketch={<Sketch />}
      className={styles.empty}
    />
  );
}

function Sketch() {
  return (
    <svg className={styles.sketch} viewBox="0 0 180 64" aria-hidden="true">
      {[0, 62, 124].map((x) => (
        <rect key={x} className={styles.slot} x={x + 1} y={1} width={54} height={62} rx={5} />
      ))}
      <path className={styles.stroke} d="M16 52V34l10-14M78 52V34l14-8M152 52V34l-14-10" />
    </svg>
  );
}

// What can be done with the selected frames, in words. Always in its place, so that nothing jumps when a frame is selected.

const ICONS = [
  ['before', 'after', 'earlier', 'later', 'duplicate'],
  ['cut', 'copy', 'paste', 'remove'],
] as const;

export function FrameTools() {
  const shown = useFrameContext();
  const { stores, id, ids } = shown;
  const context = (): FrameContext => frameContextOf(stores);
  const index = useDocument(({ present }) => indexOfFrame(present, id ?? -1));
  return (
    <div className={toolsStyles.tools} role="group" aria-label={words.actions.tools}>
      <FoldButton />
      <span className={toolsStyles.which}>
        {id === null
          ? words.actions.select
          : ids.length > 1
            ? words.actions.several({ count: ids.length })
            : words.actions.frame({ number: index + 1 })}
      </span>
      <AddsSwitch />
      <ActionButton tone="quiet" action={FRAME_ACTIONS.load} {...{ shown, context }} />
      <ActionButton tone="quiet" action={FRAME_ACTIONS.update} {...{ shown, context }} />
      {ICONS.map((names) => (
        <span key={names[0]} className={toolsStyles.icons}>
          {names.map((name) => (
            <ActionIconButton key={name} action={FRAME_ACTIONS[name]} {...{ shown, context }} />
          ))}
        </span>
      ))}
    </div>
  );
}

/** A phone has the cards on a screen of their own. */
function FoldButton() {
  const { view } = useStores();
  const isFolded = useView(({ frameCards }) => frameCards === 'folded');
  const isPhone = useLayout() === 'phone';
  if (isPhone) return null;
  return (
    <IconButton
      icon={isFolded ? 'later' : 'down'}
      label={isFolded ? words.actions.showCards : words.actions.hideCards}
      aria-expanded={!isFolded}
      onPress={() => view.setState({ frameCards: isFolded ? 'shown' : 'folded' })}
    />
  );
}

/** Drawn again whenever something changes that the actions look at. */
function useFrameContext(): FrameContext {
  const stores = useStores();
  const selected = useView((state) => state.selectedFrame);
  const whole = useWholeFrames();
  useKnowsPose();
  useSnapshot(motionHindrance);
  useDevice((state) => state.family);
  useTimeline(({ clip }) => clip !== null);
  useDocument(({ present }) => present.unit);
  useDocument(({ present }) => [present.frames[0]?.id, present.frames.at(-1)?.id].join());
  const isThere = useDocument(({ present }) => indexOfFrame(present, selected ?? -1) >= 0);
  return isThere && selected !== null
    ? { stores, id: selected, ids: together(whole, selected) }
    : { stores, id: null, ids: [] };
}
