// The slot and the repetitions of the open group. A person's choice holds until another group is opened or this one names a slot of its
// own; otherwise it is the group's slot, or a free slot of the board. Moves and stores nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { ActionGroup } from '#shared/group/group.ts';
import { ownSlot, slotFor, type KnownSlots } from '#shared/group/slotPlaces.ts';
import type { Device } from '../../../robot/device.ts';
import type { Document } from '../../groupDocument.ts';
import type { View, ViewState } from '../../view.ts';
import type { Slots } from './slots.ts';

export interface PlaceState {
  /** The slot for Download and Run. */
  readonly slot: number;
}

export interface GroupPlace {
  readonly store: StoreApi<PlaceState>;
  known(): KnownSlots;
}

export interface GroupPlaceOptions {
  readonly document: Document;
  /** The id of the open document in the library. */
  readonly opened: Pick<StoreApi<{ readonly openId: string }>, 'getState' | 'subscribe'>;
  readonly view: View;
  readonly slots: Slots;
  readonly device: Device;
}

/** 0: until stopped. */
export function chosenTimes({ times, untilStopped }: Pick<ViewState, 'times' | 'untilStopped'>): number {
  return untilStopped ? 0 : times;
}

export function createGroupPlace({ document, opened, view, slots, device }: GroupPlaceOptions): GroupPlace {
  const present = (): ActionGroup => document.store.getState().present;

  function known(): KnownSlots {
    const { family, snapshot } = device.store.getState();
    const { slotVersions, brokenSlots } = snapshot;
    const { book } = slots.store.getState();
    return { book, versions: slotVersions ?? {}, broken: brokenSlots, range: family.slot };
  }

  function slotNow(): number {
    const chosen = view.getState().slot;
    if (chosen !== null) return chosen;
    const own = ownSlot(opened.getState().openId, present(), known());
    const { commands, slot } = device.store.getState().family;
    // A board without downloads runs the groups that it came with.
    return commands.includes('download') ? slotFor(own, known()) : (own ?? slot.min);
  }

  const store = createStore<PlaceState>(() => ({ slot: slotNow() }));
  const follow = (): void => {
    const slot = slotNow();
    if (slot !== store.getState().slot) store.setState({ slot });
  };

  function beginAnew(): void {
    const { times } = present();
    view.setState({
      slot: null,
      ...(times === 0 ? { untilStopped: true } : { times, untilStopped: false }),
    });
    follow();
  }

  document.store.subscribe(({ present: now }, { present: before }) => {
    if (now.slot !== before.slot || now.times !== before.times) beginAnew();
  });
  opened.subscribe(({ openId }, before) => {
    if (openId !== before.openId) beginAnew();
  });
  view.subscribe(({ slot }, before) => {
    if (slot !== before.slot) follow();
  });
  slots.store.subscribe(follow);
  device.store.subscribe(({ family, snapshot }, before) => {
    const { slotVersions, brokenSlots } = before.snapshot;
    const isSame =
      family === before.family &&
      snapshot.slotVersions === slotVersions &&
      snapshot.brokenSlots === brokenSlots;
    if (!isSame) follow();
  });
  beginAnew();
  return { store, known };
}
