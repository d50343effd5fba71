// Puts a pose into the group as a frame, beside another one or at the end: a given one, the commanded one or
// the one that the board reported. The button that captures it shows the reason while none is known, as does the strip beside a phone's
// sliders. Moves nothing.

import { tellsPositions } from '../../../robot/readiness.ts';
import { type Stores, useDevice, useIsUnidentified, useKnownFamily, useStores } from '../../stores.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import { words } from '../../../i18n/whole.ts';
import type { Undoable } from '../../../state/store.ts';
import styles from './CaptureButton.module.css';
import stripStyles from './CaptureStrip.module.css';
import { insertFrame } from '#shared/group/groupEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';

interface CaptureButtonProps extends Required<Pick<ButtonProps, 'hint' | 'onPress'>> {
  readonly label: string;
}

export function CaptureButton({ label, hint, onPress }: CaptureButtonProps) {
  const isKnown = useKnowsPose();
  const unknown = useUnknownText();
  return (
    <>
      <Button tone="primary" icon="plus" hint={hint} isDisabled={!isKnown} onPress={onPress}>
        {label}
      </Button>
      {!isKnown && <p className={styles.hint}>{unknown}</p>}
    </>
  );
}

/** What makes a pose known. */
export const useUnknownText = (): string =>
  tellsPositions(useKnownFamily()) ? words.actions.nothingKnownOrRead : words.actions.nothingKnown;

export const useKnowsPose = (): boolean => useDevice(({ known }) => known.length > 0);

const USUAL_FRAME_MS = 1000;

type Side = 'before' | 'after' | 'end';
type Group = Pick<Stores, 'document' | 'view'>;

export function captureFrame({ device, ...group }: Group & Pick<Stores, 'device'>, side: Side): void {
  const pose = { targets: device.pose(), unit: device.store.getState().family.unit };
  putFrame(group, side, pose, () => words.actions.steps.capture);
}

/** As long as the frame it stands behind. Beside means beside the selected frame; without one it comes to the end. */
export function putFrame(
  { document, view }: Group,
  side: Side,
  { targets, unit }: { readonly targets: readonly ServoTarget[]; readonly unit: ActionGroup['unit'] },
  step: () => string,
): void {
  const { nextId, frames } = document.store.getState().present;
  const { selectedFrame } = view.getState();
  const selected = side === 'end' ? -1 : frames.findIndex(({ id }) => id === selectedFrame);
  const index = selected < 0 ? frames.length : selected + (side === 'after' ? 1 : 0);
  const durationMs = (frames[index - 1] ?? frames[0])?.durationMs ?? USUAL_FRAME_MS;
  document.edit(step, (group) => insertFrame(group, index, { durationMs, targets }, unit));
  view.setState({ selectedFrame: nextId });
}

// Beside the sliders of a phone, where the action group and the poses are a tab away: the current pose as the next frame or
// as a pose, in one press. Says what was captured and offers to take it back.

export function CaptureStrip() {
  const stores = useStores();
  const isKnown = useKnowsPose();
  const unknown = useUnknownText();
  if (useIsUnidentified()) return null;
  return (
    <section className={stripStyles.strip} aria-label={words.actions.captureHere}>
      {isKnown ? <Captures stores={stores} /> : <p className={stripStyles.hint}>{unknown}</p>}
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
