// The board panel: a strip with the frequent controls (slot, download, run, end) and below it the details.

import { useId, useRef, type ReactNode, type RefObject } from 'react';
import { slotTrigger } from '#shared/codec/families.ts';
import type { Activity } from '#shared/robot/state.ts';
import { motionHindrance, shownActivity } from '../../robot/readiness.ts';
import {
  useSnapshot,
  useStores,
  useCollisions,
  useCompiled,
  useDevice,
  useDocument,
  useSlot,
} from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/words.ts';
import { useSlotContents, CONTENT_TRUTH, useHeldName } from './slots/slotHooks.ts';
import { obstacles } from './compile/compiled.ts';
import { Chip } from '../../ui/Chip.tsx';
import { CheckedNumber } from '../CheckedNumber.tsx';
import { triggerInBar, heldText } from '../../i18n/sentences.ts';
import { DownloadControl, DownloadProgress, runAsChosen, useRunSettings } from './DownloadAndRun.tsx';
import { CollisionNote } from './compile/problems.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { PART } from '../../ui/focus.ts';
import panel from '../../ui/Panel.module.css';
import styles from './BoardPanel.module.css';

/** Runs the chosen slot, and ends a running group. */
function RunControl() {
  const { device, view, notices } = useStores();
  const { slot, times } = useRunSettings();
  const isEmpty = useSlotContents()(slot) === 'empty';
  const isPlaying = useSnapshot(({ activity }) => activity.kind === 'playing');
  const isReady = useSnapshot((snapshot) => snapshot.link.status === 'ready');
  const mayRun = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && !snapshot.brokenSlots.includes(slot),
  );
  const run = (): void => {
    runAsChosen({ device, view }, slot, times);
    if (isEmpty) notices.show('info', words.board.runsNothing({ slot }));
  };
  return (
    <>
      <Button
        icon="play"
        hint={words.board.runHint({ slot, times })}
        isDisabled={!mayRun || isPlaying}
        onPress={run}
      >
        {words.board.run}
      </Button>
      <Button
        icon="end"
        hint={words.board.stopGroupHint}
        isDisabled={!isReady}
        onPress={() => device.stopGroup()}
      >
        {words.board.stopGroup}
      </Button>
    </>
  );
}

/** What each trial of a motion needs. Between download and run: the state of the slot, or the progress of a download or run. */
function BoardStrip() {
  const { commands } = useDevice((state) => state.family);
  return (
    <>
      <SlotField />
      <div className={styles.now}>
        <Now />
      </div>
      <div className={styles.verbs}>
        {commands.includes('download') && <DownloadControl />}
        {commands.includes('run') && <RunControl />}
      </div>
    </>
  );
}

function SlotField() {
  const { view } = useStores();
  const slot = useSlot();
  const { min, max } = useDevice((state) => state.family.slot);
  return (
    <div className={styles.slot}>
      <span className={styles.boardStripLabel} aria-hidden="true">
        {words.board.slot}
      </span>
      <CheckedNumber
        label={words.board.slot}
        value={slot}
        min={min}
        max={max}
        size="small"
        onChange={(value) => view.setState({ slot: value })}
      />
    </div>
  );
}

function Now() {
  const activity = useDevice(shownActivity);
  if (activity.kind === 'downloading') return <DownloadProgress />;
  if (activity.kind === 'running') return <Running activity={activity} />;
  return <AtAGlance />;
}

/** A summary of the details below. */
function AtAGlance() {
  const slot = useSlot();
  const unit = useDocument(({ present }) => present.unit);
  const { id, unit: boardUnit } = useDevice((state) => state.family);
  const content = useSlotContents()(slot);
  const held = useHeldName()(slot) ?? '';
  const trigger = slotTrigger(id, slot);
  const { frames, report } = useCompiled((state) => state.latest);
  const mayTouch = useCollisions(({ places }) => places.length > 0);
  const isOfOther = boardUnit !== unit;
  const fits = !isOfOther && obstacles(report, 'board').length === 0;
  if (frames.length === 0) return <p className={styles.boardStripHint}>{words.board.nothingToDownload}</p>;
  return (
    <span className={styles.glance} aria-hidden="true">
      <Chip truth={CONTENT_TRUTH[content]}>{heldText(content, held)}</Chip>
      {fits && mayTouch ? (
        <CollisionNote isShort />
      ) : (
        <Chip truth={fits ? 'confirmed' : 'danger'}>
          {isOfOther ? words.compile.ofOther : fits ? words.compile.fits : words.compile.fitsNot}
        </Chip>
      )}
      {trigger !== null && <Chip truth="warning">{triggerInBar(trigger)}</Chip>}
    </span>
  );
}

const TRUTH = { requested: 'commanded', acknowledged: 'confirmed', unknown: 'unknown' } as const;

function Running({ activity }: { readonly activity: Extract<Activity, { kind: 'running' }> }) {
  return (
    <div className={styles.run}>
      <Chip truth={TRUTH[activity.truth]}>
        {words.activity.running({ slot: activity.slot, times: activity.times })}
      </Chip>
      <p>{words.activity.runTruth[activity.truth]}</p>
    </div>
  );
}

const BoardDetails = laterComponent(async () => (await import('./BoardDetails.tsx')).BoardDetails, '240px');

interface BoardPanelProps {
  /** The strip and the details fill the column around them: the strip stays in sight, the details scroll. */
  readonly isSpread?: boolean;
  /** How the open group fits the board. */
  readonly fit: ReactNode;
}

export function BoardPanel({ isSpread = false, fit }: BoardPanelProps) {
  const titleId = useId();
  const details = useRef<HTMLDivElement>(null);
  return (
    <section {...PART} className={isSpread ? styles.spread : panel.panel} aria-labelledby={titleId}>
      <header className={styles.strip}>
        <h2 id={titleId} className={panel.title}>
          {words.board.title}
        </h2>
        <BoardStrip />
        {isSpread && <DetailsButton details={details} />}
      </header>
      <div ref={details} className={styles.rows}>
        <BoardDetails fit={fit} />
      </div>
    </section>
  );
}

/** Scrolls to the details and back. */
function DetailsButton({ details }: { readonly details: RefObject<HTMLElement | null> }) {
  const turn = (): void => {
    const column = details.current?.closest('[data-column]');
    const isThere = (column?.scrollTop ?? 0) > 0;
    if (isThere) column?.scrollTo({ top: 0 });
    else details.current?.scrollIntoView({ block: 'end' });
  };
  return (
    <span className={styles.turn}>
      <Button tone="quiet" icon="down" onPress={turn}>
        {words.board.details}
      </Button>
    </span>
  );
}
