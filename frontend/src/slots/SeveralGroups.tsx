// Several groups of the library for the board: which ones, to which slots, whether each fits; then one download with one progress.

import { useEffect, useMemo, useState } from 'react';
import type { ActionGroup } from '#shared/actions/group/group.ts';
import type { Listed } from '#shared/actions/library/keeper.ts';
import { DownloadProgress } from '../board/DownloadProgress.tsx';
import { startHindrance } from '../stores/device/readiness.ts';
import { useDevice, useLibrary, useRobot, useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { cx } from '../ui/cx.ts';
import { NumberField } from '../ui/NumberField.tsx';
import { words } from '../words/words.ts';
import { downloadOf, hindranceOf, slotFor, type Wanted } from './several.ts';
import styles from './Slots.module.css';

interface Pick {
  readonly documentId: string;
  readonly slot: number;
  readonly group: ActionGroup;
}

export function SeveralGroups({ onBack }: { onBack(): void }) {
  const { library, slots } = useStores();
  const documents = useLibrary((state) => state.documents).filter(({ isRemoved }) => !isRemoved);
  const { wanted, toggle, setSlot, take, none } = useWanted();
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const isReady = wanted.length > 0 && wanted.every((one) => hindranceOf(one, wanted) === null);
  useEffect(() => void library.refresh(), [library]);
  return (
    <section className={styles.details} aria-label={words.slots.several.title}>
      <h3>{words.slots.several.title}</h3>
      <p className={styles.dim}>{words.slots.several.hint}</p>
      {documents.length > 1 && (
        <All
          {...{ chosen: wanted.length, count: documents.length }}
          onChange={(wantsAll) => (wantsAll ? void take(documents.map(({ id }) => id)) : none())}
        />
      )}
      <ul className={styles.groups} aria-label={words.slots.several.list}>
        {documents.map((document) => (
          <Group
            key={document.id}
            {...{ document, toggle, setSlot, all: wanted }}
            one={wanted.find(({ documentId }) => documentId === document.id)}
          />
        ))}
      </ul>
      <p className={styles.dim} role="status">
        {wanted.length === 0 ? words.slots.several.none : totalOf(wanted)}
      </p>
      <div className={styles.verbs}>
        <Button
          tone="primary"
          icon="download"
          isDisabled={!mayStart || !isReady}
          onPress={() => slots.download(wanted.map(downloadOf))}
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
  return words.slots.several.total(wanted.length, frames, downloadMs);
}

/** Compiled anew where the board, the robot or what is wanted is another one. */
function useWanted() {
  const { library, compiled, slots, device } = useStores();
  const family = useDevice((state) => state.family);
  const robot = useRobot();
  const [picks, setPicks] = useState<readonly Pick[]>([]);
  const wanted = useMemo(
    () =>
      picks.map(({ group, ...pick }): Wanted => ({
        ...pick,
        compiled: compiled.of(group, { family, robot }),
      })),
    [picks, compiled, family, robot],
  );

  const isPicked = (documentId: string): boolean => picks.some((pick) => pick.documentId === documentId);

  async function take(documentIds: readonly string[]): Promise<void> {
    for (const documentId of documentIds.filter((id) => !isPicked(id))) {
      const group = await library.group(documentId);
      if (group !== null) put(documentId, group);
    }
  }

  function put(documentId: string, group: ActionGroup): void {
    setPicks((before) => {
      const ofOthers = Object.keys(device.store.getState().snapshot.slotVersions ?? {}).map(Number);
      const taken = [...before.map(({ slot }) => slot), ...ofOthers];
      const { book } = slots.store.getState();
      const slot = slotFor(group.slot, book, taken, device.store.getState().family.slot);
      return [...before.filter((pick) => pick.documentId !== documentId), { documentId, slot, group }];
    });
  }

  return {
    wanted,
    take,
    none: (): void => setPicks([]),
    toggle(documentId: string): void {
      if (isPicked(documentId)) setPicks((before) => before.filter((pick) => pick.documentId !== documentId));
      else void take([documentId]);
    },
    setSlot: (documentId: string, slot: number): void =>
      setPicks((before) => before.map((pick) => (pick.documentId === documentId ? { ...pick, slot } : pick))),
  };
}

interface AllProps {
  readonly chosen: number;
  readonly count: number;
  onChange(wantsAll: boolean): void;
}

/** Neither on nor off where some of them are chosen; the next press chooses the others. */
function All({ chosen, count, onChange }: AllProps) {
  const isAll = chosen === count;
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
      <span>{words.slots.several.all(count)}</span>
    </label>
  );
}

interface GroupProps {
  readonly document: Listed;
  /** Where it is wanted. */
  readonly one: Wanted | undefined;
  readonly all: readonly Wanted[];
  toggle(documentId: string): void;
  setSlot(documentId: string, slot: number): void;
}

function Group({ document: { id, facts }, one, all, toggle, setSlot }: GroupProps) {
  const { notices } = useStores();
  const { min, max } = useDevice((state) => state.family.slot);
  const label = words.slots.several.slotOf(facts.name);
  const hindrance = one === undefined ? null : hindranceOf(one, all);
  return (
    <li className={styles.group}>
      <label className={styles.choice}>
        <input type="checkbox" checked={one !== undefined} onChange={() => toggle(id)} />
        <span className={styles.held}>{facts.name}</span>
        <span className={styles.dim}>{words.slots.several.about(facts.frames, facts.durationMs)}</span>
      </label>
      {one !== undefined && (
        <NumberField
          label={label}
          size="small"
          value={one.slot}
          min={min}
          max={max}
          onChange={(slot) => setSlot(id, slot)}
          onRefused={(slot) => notices.tell('warning', words.refused(label, slot, min, max))}
        />
      )}
      {hindrance !== null && <p className={styles.warning}>{hindrance}</p>}
    </li>
  );
}
