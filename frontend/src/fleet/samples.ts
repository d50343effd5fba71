// Robots of a fleet as the gallery and tests show them.

import type { FleetRobot } from '#shared/client/http.generated.ts';

type State = NonNullable<FleetRobot['state']>;

/** A robot that is ready; `state` changes parts of its state. */
export function fleetRobot(
  id: string,
  { state, ...rest }: Omit<Partial<FleetRobot>, 'state'> & { readonly state?: Partial<State> | null } = {},
): FleetRobot {
  const ready: State = {
    ...{ link: 'ready', latch: false, stoppedBy: null, driver: null, running: null, batteryMv: 7500 },
  };
  return {
    ...{
      id,
      name: id,
      robot: 'Arm',
      board: 'lsc-6',
      version: '0.1.0',
      page: '',
      limits: [],
      lowBatteryMv: null,
      slots: [],
    },
    ...{ groups: [], presence: 'present', seenMsAgo: null },
    state: state === null ? null : { ...ready, ...state },
    ...rest,
  };
}
