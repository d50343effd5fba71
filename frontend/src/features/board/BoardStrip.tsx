// What is done with the board in every round of trying a motion: choose the slot, download to it, run it, end it. Between the
// two, what is known of the slot, or how far a download or a run has come.

import { obstacles } from '../animate/group/compiled.ts';
import { useCompiled, useDevice, useDocument, useSnapshot, useStores, useSlot } from '../stores.ts';
import { FATE_TRUTH, useFates } from './slots/useFates.ts';
import { useHeldName } from './slots/useHeldName.ts';
import { Chip } from '../../ui/Chip.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { triggerInBar, heldText } from '../../i18n/sentences/slots.ts';
import { words } from '../../i18n/words.ts';
import { slotTrigger } from '#shared/codec/families.ts';
import type { Activity } from '#shared/session/state.ts';
import { DownloadControl } from './DownloadControl.tsx';
import { DownloadProgress } from './DownloadProgress.tsx';
import { RunControl } from './RunControl.tsx';
import styles from './BoardStrip.module.css';

export function BoardStrip() {
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
  const { view, notices } = useStores();
  const slot = useSlot();
  const { min, max } = useDevice((state) => state.family.slot);
  return (
    <div className={styles.slot}>
      <span className={styles.label} aria-hidden="true">
        {words.board.slot}
      </span>
      <NumberField
        label={words.board.slot}
        value={slot}
        min={min}
        max={max}
        size="small"
        onChange={(value) => view.setState({ slot: value })}
        onRefused={(value) => notices.refuse(words.refused({ name: words.board.slot, value, min, max }))}
      />
    </div>
  );
}

function Now() {
  const activity = useSnapshot((snapshot) => snapshot.activity);
  if (activity.kind === 'downloading') return <DownloadProgress />;
  if (activity.kind === 'running') return <Running activity={activity} />;
  return <AtAGlance />;
}

/** What the details below say in full. */
function AtAGlance() {
  const slot = useSlot();
  const unit = useDocument(({ present }) => present.unit);
  const { id, unit: boardUnit } = useDevice((state) => state.family);
  const fate = useFates()(slot);
  const held = useHeldName()(slot) ?? '';
  const trigger = slotTrigger(id, slot);
  const { frames, report } = useCompiled((state) => state.latest);
  const isOfOther = boardUnit !== unit;
  const fits = !isOfOther && obstacles(report, 'board').length === 0;
  if (frames.length === 0) return <p className={styles.hint}>{words.board.nothingToDownload}</p>;
  return (
    <span className={styles.glance} aria-hidden="true">
      <Chip truth={FATE_TRUTH[fate]}>{heldText(fate, held)}</Chip>
      <Chip truth={fits ? 'confirmed' : 'danger'}>
        {isOfOther ? words.compile.ofOther : fits ? words.compile.fits : words.compile.fitsNot}
      </Chip>
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
