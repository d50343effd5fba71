// Several groups of the library for the board: which ones, to which slots, whether each fits; then one download with one progress.

import { useEffect } from 'react';
import type { Listed } from '#shared/files/keeper.ts';
import { DownloadProgress } from '../DownloadProgress.tsx';
import { startHindrance } from '../../../robot/readiness.ts';
import { useDevice, useLibrary, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { cx } from '../../../ui/cx.ts';
import { NumberField } from '../../../ui/NumberField.tsx';
import { words } from '../../../i18n/whole.ts';
import { downloadOf, hindranceOf, type Wanted } from './several.ts';
import { useWanted } from './useWanted.ts';
import styles from './Slots.module.css';

export function SeveralGroups({ onBack }: { onBack(): void }) {
  const { library, replacing } = useStores();
  const documents = useLibrary((state) => state.documents).filter(({ isRemoved }) => !isRemoved);
  const { wanted, cannot, toggle, setSlot, takeAll, none } = useWanted();
  const waitsFor = useSnapshot(startHindrance);
  const isReady = wanted.length > 0 && wanted.every((one) => hindranceOf(one, wanted) === null);
  const hindranceIn = (id: string): string | null => {
    const one = [...wanted, ...cannot].find(({ documentId }) => documentId === id);
    return one === undefined ? null : hindranceOf(one, wanted);
  };
  useEffect(() => void library.refresh(), [library]);
  return (
    <section className={styles.details} aria-label={words.slots.several.title}>
      <h3>{words.slots.several.title}</h3>
      <p className={styles.dim}>{words.slots.several.hint}</p>
      {documents.length > 1 && (
        <All
          {...{ chosen: wanted.length, left: cannot.length, count: documents.length }}
          onChange={(wantsAll) => (wantsAll ? void takeAll(documents.map(({ id }) => id)) : none())}
        />
      )}
      <ul className={styles.groups} aria-label={words.slots.several.list}>
        {documents.map((document) => (
          <Group
            key={document.id}
            {...{ document, toggle, setSlot }}
            one={wanted.find(({ documentId }) => documentId === document.id)}
            hindrance={hindranceIn(document.id)}
          />
        ))}
      </ul>
      <div role="status">
        {cannot.length > 0 && (
          <p className={styles.warning}>{words.slots.several.cannot({ count: cannot.length })}</p>
        )}
        <p className={styles.dim}>{wanted.length === 0 ? words.slots.several.none : totalOf(wanted)}</p>
        {/* What is busy says so itself. */}
        {waitsFor !== null && waitsFor !== 'busy' && (
          <p className={styles.warning}>{words.servos.blocked[waitsFor]}</p>
        )}
      </div>
      <div className={styles.verbs}>
        <Button
          tone="primary"
          icon="download"
          isDisabled={waitsFor !== null || !isReady}
          onPress={() => replacing.download(wanted.map(downloadOf))}
        >
          {words.slots.several.download}
        </Button>
        <Button onPress={onBack}>{words.slots.several.back}</Button>
      </div>
      <DownloadProgress />
    </section>
  );
}

function totalOf(wanted: readonly Wanted[]): string {
  const frames = wanted.reduce((sum, { compiled }) => sum + compiled.frames.length, 0);
  const downloadMs = wanted.reduce((sum, { compiled }) => sum + (compiled.report.downloadMs ?? 0), 0);
  return words.slots.several.total({ count: wanted.length, frames, downloadMs });
}

interface AllProps {
  readonly chosen: number;
  /** Asked for, and cannot go. */
  readonly left: number;
  readonly count: number;
  onChange(wantsAll: boolean): void;
}

/** Neither on nor off where some of them are chosen; the next press chooses the others that can go. */
function All({ chosen, left, count, onChange }: AllProps) {
  const isAll = chosen > 0 && chosen + left === count;
  return (
    <label className={cx(styles.choice, styles.all)}>
      <input
        type="checkbox"
        ref={(box) => {
          if (box !== null) box.indeterminate = chosen > 0 && !isAll;
        }}
        checked={isAll}
        onChange={() => onChange(!isAll)}
      />
      <span>{words.slots.several.all({ count })}</span>
    </label>
  );
}

interface GroupProps {
  readonly document: Listed;
  /** Where it is wanted. */
  readonly one: Wanted | undefined;
  /** What keeps it from the board, where somebody asked for it. */
  readonly hindrance: string | null;
  toggle(documentId: string): void;
  setSlot(documentId: string, slot: number): void;
}

function Group({ document: { id, facts }, one, hindrance, toggle, setSlot }: GroupProps) {
  const { notices } = useStores();
  const { min, max } = useDevice((state) => state.family.slot);
  const label = words.slots.several.slotOf({ name: facts.name });
  return (
    <li className={styles.group}>
      <label className={styles.choice}>
        <input type="checkbox" checked={one !== undefined} onChange={() => toggle(id)} />
        <span className={styles.held}>{facts.name}</span>
        <span className={styles.dim}>
          {words.slots.several.about({ count: facts.frames, durationMs: facts.durationMs })}
        </span>
      </label>
      {one !== undefined && (
        <NumberField
          label={label}
          size="small"
          value={one.slot}
          min={min}
          max={max}
          onChange={(slot) => setSlot(id, slot)}
          onRefused={(slot) => notices.refuse(words.refused({ name: label, value: slot, min, max }))}
        />
      )}
      {hindrance !== null && <p className={styles.warning}>{hindrance}</p>}
    </li>
  );
}
