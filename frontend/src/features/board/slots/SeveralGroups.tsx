// Downloads several groups of the library at once: which ones, to which slots, and why some cannot be downloaded.

import { compileSource } from '../compile/compileSource.ts';
import { problemText } from '../compile/problems.tsx';
import { useMemo, useState, useEffect } from 'react';
import { holdsMotion, type ActionGroup } from '#shared/group/group.ts';
import { ownSlot, slotFor } from '#shared/group/slotPlaces.ts';
import type { Listed } from '#shared/files/documentStore.ts';
import { useDevice, useRobot, useStores, useLibrary, useSnapshot } from '../../stores.ts';
import { DownloadProgress } from '../DownloadAndRun.tsx';
import { startHindrance } from '../../../robot/readiness.ts';
import { Button } from '../../../ui/Button.tsx';
import { cx } from '../../../ui/cx.ts';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { words } from '../../../i18n/whole.ts';
import styles from './Slots.module.css';
import { obstacles, type CompiledGroup } from '../compile/compiled.ts';
import type { SlotDownload } from './slots.ts';

interface Pick {
  readonly documentId: string;
  readonly slot: number;
  readonly group: ActionGroup;
}

/** The chosen groups, compiled for the board, and those that “All” could not include. */
function useWanted() {
  const { library, compiled, place } = useStores();
  const family = useDevice((state) => state.family);
  const robot = useRobot();
  const [chosen, setChosen] = useState<readonly Pick[]>([]);
  const [left, setLeft] = useState<readonly Pick[]>([]);

  const [wanted, cannot] = useMemo(() => {
    const asWanted = ({ group, ...pick }: Pick): Wanted => ({
      ...pick,
      compiled: compiled.of(group, { family, robot }, compileSource),
    });
    const those = chosen.map(asWanted);
    return [those, left.map(asWanted).filter((one) => hindranceOf(one, those) !== null)] as const;
  }, [chosen, left, compiled, family, robot]);

  const isIn = (picks: readonly Pick[], id: string): boolean =>
    picks.some(({ documentId }) => documentId === id);

  async function take(documentId: string): Promise<void> {
    const group = await library.group(documentId);
    if (group === null) return;
    setChosen((before) => {
      const others = without(before, documentId);
      const known = place.known();
      const taken = others.map((pick) => pick.slot);
      const slot = slotFor(ownSlot(documentId, group, known), known, taken);
      return [...others, { documentId, slot, group }];
    });
    setLeft((before) => without(before, documentId));
  }

  /** Chooses all groups that can be downloaded; for the others the reason is shown. */
  async function takeAll(documentIds: readonly string[]): Promise<void> {
    const groups = await Promise.all(
      documentIds.map(async (documentId) => ({ documentId, group: await library.group(documentId) })),
    );
    const known = place.known();
    const candidates = groups.flatMap(({ documentId, group }) =>
      group === null || isIn(chosen, documentId)
        ? []
        : [
            {
              documentId,
              compiled: compiled.of(group, { family, robot }, compileSource),
              own: ownSlot(documentId, group, known),
            },
          ],
    );
    const sorted = thoseThatCan(candidates, wanted, (own, taken) => slotFor(own, known, taken));
    setChosen((before) => [
      ...before,
      ...sorted.can.map(pickOf).filter(({ documentId }) => !isIn(before, documentId)),
    ]);
    setLeft(sorted.cannot.map(pickOf));
  }

  return {
    wanted,
    /** Requested by “All”. */
    cannot,
    takeAll,
    none(): void {
      setChosen([]);
      setLeft([]);
    },
    toggle(documentId: string): void {
      if (isIn(chosen, documentId)) setChosen((before) => without(before, documentId));
      else void take(documentId);
    },
    setSlot: (id: string, slot: number): void =>
      setChosen((before) => before.map((pick) => (pick.documentId === id ? { ...pick, slot } : pick))),
  };
}

const without = (picks: readonly Pick[], id: string): readonly Pick[] =>
  picks.filter(({ documentId }) => documentId !== id);

const pickOf = ({ documentId, slot, compiled }: Wanted): Pick => ({
  ...{ documentId, slot, group: compiled.source.group },
});

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
  /** Requested by “All” and impossible. */
  readonly left: number;
  readonly count: number;
  onChange(wantsAll: boolean): void;
}

/** Mixed if only some are chosen; the next press then chooses all others that can be downloaded. */
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
  /** Its choice of a slot. */
  readonly one: Wanted | undefined;
  /** Why it cannot be downloaded; null if it can, or if it is not requested. */
  readonly hindrance: string | null;
  toggle(documentId: string): void;
  setSlot(documentId: string, slot: number): void;
}

function Group({ document: { id, facts }, one, hindrance, toggle, setSlot }: GroupProps) {
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
        <CheckedNumber
          label={label}
          size="small"
          value={one.slot}
          min={min}
          max={max}
          onChange={(slot) => setSlot(id, slot)}
        />
      )}
      {hindrance !== null && <p className={styles.warning}>{hindrance}</p>}
    </li>
  );
}

export interface Wanted {
  readonly documentId: string;
  readonly slot: number;
  readonly compiled: CompiledGroup;
}

/** `own`: the slot that is stored in the group. */
type Requested = Omit<Wanted, 'slot'> & { readonly own: number | null };

/** Why a group cannot be downloaded; null if it can. */
export function hindranceOf(one: Wanted, all: readonly Wanted[]): string | null {
  const { group } = one.compiled.source;
  const [problem] = obstacles(one.compiled.report, 'board');
  if (problem !== undefined) return problemText(problem, one.compiled.source);
  if (!holdsMotion(group)) return words.slots.several.noFrame;
  const isTaken = all.some((other) => other !== one && other.slot === one.slot);
  return isTaken ? words.slots.several.sameSlot({ slot: one.slot }) : null;
}

/**
 * Splits requested groups into those that can be downloaded beside the ones already chosen, and the others. Groups that name a slot get
 * theirs before groups that take any. `placeOf`: as `slotFor`, without the slots that are taken.
 */
export function thoseThatCan(
  requested: readonly Requested[],
  wanted: readonly Wanted[],
  placeOf: (own: number | null, taken: readonly number[]) => number,
): { readonly can: readonly Wanted[]; readonly cannot: readonly Wanted[] } {
  const [can, cannot]: [Wanted[], Wanted[]] = [[], []];
  for (const { own, ...one } of requested.toSorted(
    (a, b) => Number(a.own === null) - Number(b.own === null),
  )) {
    const before = [...wanted, ...can];
    const taken = before.map(({ slot }) => slot);
    const placed = { ...one, slot: placeOf(own, taken) };
    (hindranceOf(placed, before) === null ? can : cannot).push(placed);
  }
  return { can, cannot };
}

export function downloadOf({ documentId, slot, compiled }: Wanted): SlotDownload {
  return { documentId, slot, name: compiled.source.group.name, frames: compiled.frames };
}
