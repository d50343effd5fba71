// A run as it was chosen beside its button: bound to this page, or, for this one time, to go on without it. Knows the
// choice; when such a run ends is the gateway's to say.

import type { Device } from '../../../robot/device.ts';
import type { View } from '../../view.ts';

interface Parts {
  readonly device: Device;
  readonly view: View;
}

/** `settled` as for `device.run`. */
export function runAsChosen(
  { device, view }: Parts,
  slot: number,
  times: number,
  settled: (isTaken: boolean) => void = () => undefined,
): void {
  const { goesOn, goOnMinutes } = view.getState();
  view.setState({ goesOn: false });
  device.run(slot, times, (isTaken) => {
    if (isTaken && goesOn) device.letGoOn(goOnMinutes * 60_000);
    settled(isTaken);
  });
}
