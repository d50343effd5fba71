// Keys and pad in their states: without a pad, held, driving with unknown positions, in conflict.

import { step } from '#shared/profile/mappingStep.ts';
import type { Binding } from '#shared/profile/mapping.ts';
import { padParts } from '../../features/inputs/PadPanel.tsx';
import { AuthoringPanel } from '../Authoring.tsx';
import type { Gamepadlike } from '../../features/inputs/pad.ts';
import { useStores, type Stores } from '../../features/stores.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/whole.ts';
import { standing, type Exhibit } from './exhibit.ts';
import { SIMULATED } from './states.ts';

interface PadSpecimen {
  readonly name: string;
  readonly pad: Gamepadlike | null;
  readonly isDriving?: boolean;
  readonly more?: readonly Binding[];
}

const HELD: Gamepadlike = {
  ...{ id: 'Wireless Controller', index: 0, mapping: 'standard' },
  axes: [0.7, -0.4, 0, 1],
  buttons: Array.from({ length: 17 }, (_, at) => ({ value: at === 7 ? 0.6 : at % 5 === 0 ? 1 : 0 })),
};

const CASES: readonly PadSpecimen[] = [
  { name: 'Pad, none seen', pad: null },
  { name: 'Pad, held', pad: HELD },
  { name: 'Pad, unusual', pad: { ...HELD, mapping: '' } },
  { name: 'Pad, driving', pad: null, isDriving: true },
  {
    name: 'Pad, conflicts',
    pad: HELD,
    more: [
      { input: { kind: 'key', code: 'KeyQ' }, action: { kind: 'run', slot: 5 } },
      {
        input: { kind: 'button', index: 2 },
        action: { kind: 'pose', pose: 'rest', durationMs: 1500 },
      },
      {
        input: { kind: 'axis', index: 0, side: 'whole' },
        action: { kind: 'position', servo: 1, isReversed: false },
      },
      { input: { kind: 'key', code: 'KeyZ' }, action: { kind: 'rate', servo: 9, unitsPerS: 100 } },
    ],
  },
];

function Driven() {
  const { pad } = useStores();
  useEachFrame(() => pad.frame());
  return <AuthoringPanel {...padParts} />;
}

export const PADS: readonly Exhibit[] = CASES.map((specimen) => ({
  name: specimen.name,
  content: <Driven />,
  stores: () => storesOf(specimen),
}));

function storesOf({ pad: held, isDriving = false, more = [] }: PadSpecimen): Stores {
  const stores = standing({ way: SIMULATED, pad: held });
  const { mappings, pad, view } = stores;
  view.setState({ authoring: 'pad' });
  mappings.edit(
    () => words.pad.steps.ready,
    (mapping) => ({ ...mapping, bindings: [...mapping.bindings, ...more] }),
  );
  pad.drive(isDriving ? step : null);
  return stores;
}
