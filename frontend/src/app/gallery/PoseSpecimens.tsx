// Poses and buttons in their states.

import type { ReactNode } from 'react';
import { addMacro, changeMacro } from '#shared/profile/macroEdits.ts';
import { addPose, markApplied, markRest, type PoseBook } from '#shared/profile/pose.ts';
import { CaptureStrip } from '../CaptureStrip.tsx';
import { ButtonsPage } from '../../features/buttons/ButtonsPage.tsx';
import { Kiosk } from '../Kiosk.tsx';
import { BlendBar } from '../../features/poses/BlendBar.tsx';
import { posesParts } from '../../features/poses/PosesPanel.tsx';
import { AuthoringPanel } from '../Authoring.tsx';
import { useSelectedPose } from '../../features/poses/naming.ts';
import type { Stores } from '../../features/stores.ts';
import { words } from '../../i18n/words.ts';
import { standing, type Exhibit } from './exhibit.ts';

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
