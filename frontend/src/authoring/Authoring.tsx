// The authoring area: action group, poses, or keys and pad, in the same place.

import { ActionsPanel } from '../actions/ActionsPanel.tsx';
import { PadPanel } from '../pad/PadPanel.tsx';
import { PosesPanel } from '../poses/PosesPanel.tsx';
import { useView } from '../stores/stores.ts';

const PANELS = { group: ActionsPanel, poses: PosesPanel, pad: PadPanel } as const;

export function Authoring() {
  const Shown = PANELS[useView((state) => state.authoring)];
  return <Shown />;
}
