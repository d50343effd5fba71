// Poses, buttons, and the keys and pad in their states.

import type { ReactNode } from 'react';
import { addMacro, changeMacro } from '#shared/profile/macroEdits.ts';
import { addPose, markApplied, markRest, type PoseBook } from '#shared/profile/pose.ts';
import { CaptureStrip } from '../../features/animate/frames/CaptureButton.tsx';
import { ButtonsPage } from '../../features/buttons/ButtonsPage.tsx';
import { Kiosk } from '../Kiosk.tsx';
import { BlendBar } from '../../features/poses/BlendBar.tsx';
import { posesParts } from '../../features/poses/PosesPanel.tsx';
import { AuthoringPanel } from '../Authoring.tsx';
import { useSelectedPose } from '../../features/poses/PoseCard.tsx';
import { type Stores, useStores } from '../../features/stores.ts';
import { standing, type Exhibit } from './exhibit.ts';
import { step } from '#shared/profile/mappingStep.ts';
import type { Binding } from '#shared/profile/mapping.ts';
import { padParts } from '../../features/inputs/PadPanel.tsx';
import type { Gamepadlike } from '../../features/inputs/pad.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/whole.ts';
import { SIMULATED } from './states.ts';

const NAMED = { 'Greet the visitor': 0.2, 'Look down': 0.5, Sit: 0.8 };

function fill({ poses, macros, view }: Stores, edits: boolean): void {
  const targets = (share: number) =>
    [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, position: 700 + Math.round(share * servo * 260) }));
  poses.book.edit(
    () => words.poses.steps.import,
    (empty) => {
      const book = Object.entries(NAMED).reduce<PoseBook>(
        (sum, [name, share]) => addPose(sum, { name, unit: 'us', targets: targets(share) }),
        empty,
      );
      return markApplied(markRest(book, 3), 1);
    },
  );
  Object.keys(NAMED).forEach((name, index) => {
    const go = { kind: 'pose', pose: index + 1, durationMs: 1500 } as const;
    macros.edit(
      () => words.poses.steps.import,
      (page) => addMacro(page, name, [go, { kind: 'wait', waitMs: 500 }]),
    );
  });
  macros.edit(
    () => words.poses.steps.import,
    (page) => changeMacro(addMacro(page, 'Dance', []), 1, { key: 'g' }),
  );
  view.setState({ authoring: 'poses', selectedPose: 1, selectedButton: 1, editsButtons: edits });
}

const CASES: readonly {
  readonly name: string;
  readonly panel: ReactNode;
  readonly isEmpty?: boolean;
  readonly edits?: boolean;
  readonly isUnknown?: boolean;
}[] = [
  { name: 'Poses, none', panel: <AuthoringPanel {...posesParts} />, isEmpty: true },
  { name: 'Poses', panel: <AuthoringPanel {...posesParts} /> },
  { name: 'Poses, robot follows a blend', panel: <Blend /> },
  { name: 'Capture beside the sliders', panel: <CaptureStrip /> },
  { name: 'Capture, nothing known', panel: <CaptureStrip />, isUnknown: true },
  { name: 'Buttons, none', panel: <ButtonsPage />, isEmpty: true },
  { name: 'Buttons', panel: <ButtonsPage /> },
  { name: 'Buttons, being changed', panel: <ButtonsPage />, edits: true },
  { name: 'Kiosk', panel: <Kiosk onMoveHere={() => undefined} /> },
];

function Blend() {
  const pose = useSelectedPose();
  return pose === undefined ? null : <BlendBar pose={pose} otherFirst={2} />;
}

export const POSES: readonly Exhibit[] = CASES.map(({ name, panel, ...rest }) => ({
  name,
  content: panel,
  stores: () => storesOf(rest),
}));

type Case = Omit<(typeof CASES)[number], 'name' | 'panel'>;

function storesOf({ isEmpty = false, edits = false, isUnknown = false }: Case): Stores {
  const stores = standing({ pose: isUnknown ? 'unknown' : 'still' });
  if (!isEmpty) fill(stores, edits);
  stores.blend.store.setState({ isLive: true, targets: [] });
  return stores;
}

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

const PAD_CASES: readonly PadSpecimen[] = [
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

export const PADS: readonly Exhibit[] = PAD_CASES.map((specimen) => ({
  name: specimen.name,
  content: <Driven />,
  stores: () => padStores(specimen),
}));

function padStores({ pad: held, isDriving = false, more = [] }: PadSpecimen): Stores {
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
