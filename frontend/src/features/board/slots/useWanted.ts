// Which groups of the library are wanted on the board, and which could not go when all of them were asked for. Compiled anew where
// the board, the robot or what is wanted is another one.

import { useMemo, useState } from 'react';
import type { ActionGroup } from '#shared/group/group.ts';
import { ownSlot, slotFor } from '#shared/group/slotPlaces.ts';
import { useDevice, useRobot, useStores } from '../../stores.ts';
import { hindranceOf, thoseThatCan, type Wanted } from './several.ts';

interface Pick {
  readonly documentId: string;
  readonly slot: number;
  readonly group: ActionGroup;
}

export function useWanted() {
  const { library, compiled, place } = useStores();
  const family = useDevice((state) => state.family);
  const robot = useRobot();
  const [chosen, setChosen] = useState<readonly Pick[]>([]);
  const [left, setLeft] = useState<readonly Pick[]>([]);

  const [wanted, cannot] = useMemo(() => {
    const asWanted = ({ group, ...pick }: Pick): Wanted => ({
      ...pick,
      compiled: compiled.of(group, { family, robot }),
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

  /** Those that can go; of the others is told what keeps them. */
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
              compiled: compiled.of(group, { family, robot }),
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
    /** Asked for with all the others. */
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
