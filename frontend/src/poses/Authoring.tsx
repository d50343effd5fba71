// The authoring area: action group or poses, in the same place.

import { ActionsPanel } from '../actions/ActionsPanel.tsx';
import { useView } from '../stores/stores.ts';
import { PosesPanel } from './PosesPanel.tsx';

export function Authoring() {
  return useView((state) => state.authoring) === 'poses' ? <PosesPanel /> : <ActionsPanel />;
}
