// Keys and pad in each of their states: without a pad, held, driving with servos that nobody knows, in conflict.

import { useState } from 'react';
import { FAMILIES } from '#shared/protocol/families.ts';
import type { Binding } from '#shared/actions/mapping/mapping.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import { PadPanel } from '../pad/PadPanel.tsx';
import type { Gamepadlike } from '../stores/pad.ts';
import { StoresContext, type Stores } from '../stores/stores.ts';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { frozenSession } from './frozen.ts';
import { specimenStores } from './specimenStores.ts';
import { words } from '../words/words.ts';
import styles from './Gallery.module.css';

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
        input: { kind: 'axis', index: 0, side: 'whole' },
        action: { kind: 'position', servo: 1, isReversed: false },
      },
      { input: { kind: 'key', code: 'KeyZ' }, action: { kind: 'rate', servo: 9, unitsPerS: 100 } },
    ],
  },
];

export function PadSpecimens() {
  return CASES.map((specimen) => <Shown key={specimen.name} specimen={specimen} />);
}

function Shown({ specimen }: { readonly specimen: PadSpecimen }) {
  const [stores] = useState(() => storesOf(specimen));
  useEachFrame(() => stores.pad.frame());
  return (
    <StoresContext value={stores}>
      <article className={styles.specimen} aria-label={specimen.name}>
        <h2 className={styles.name} lang="en">
          {specimen.name}
        </h2>
        <PadPanel />
      </article>
    </StoresContext>
  );
}

function storesOf({ pad: held, isDriving = false, more = [] }: PadSpecimen): Stores {
  const stores = specimenStores(FAMILIES.doc, held);
  const { device, mappings, pad, view } = stores;
  view.setState({ authoring: 'pad' });
  device.attach(frozenSession(FAMILIES.doc, { ...INITIAL_STATE, link: { status: 'ready' } }, {}), {
    ...{ kind: 'simulated', label: 'Simulated board', isSimulated: true },
  });
  mappings.edit(
    () => words.pad.steps.ready,
    (mapping) => ({ ...mapping, bindings: [...mapping.bindings, ...more] }),
  );
  pad.drive(isDriving);
  return stores;
}
