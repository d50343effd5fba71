// The fleet of this page, for its parts.

import { createContext, use } from 'react';
import { useStore } from 'zustand';
import type { Fleet, FleetState } from './fleetStore.ts';

export const FleetContext = createContext<Fleet | null>(null);

export function useFleet(): Fleet {
  const fleet = use(FleetContext);
  if (fleet === null) throw new Error('outside of the fleet page');
  return fleet;
}

export const useFleetState = <T>(select: (state: FleetState) => T): T => useStore(useFleet().store, select);
