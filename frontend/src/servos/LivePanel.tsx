// The place of live control: the servos, or, while nobody has said which board this is, the question.

import { WhichBoard } from '../identity/WhichBoard.tsx';
import { useDevice } from '../stores/stores.ts';
import { ServosPanel } from './ServosPanel.tsx';

export function LivePanel() {
  const isUnknown = useDevice(({ family, way }) => family.id === 'unknown' && way !== null);
  return isUnknown ? <WhichBoard /> : <ServosPanel />;
}
