// The place of live control: the servos, or, while nobody has said which board this is, the question.

import { useDevice } from '../stores.ts';
import { laterComponent } from '../../ui/later.tsx';
import { ServosPanel } from './ServosPanel.tsx';

const WhichBoard = laterComponent(
  async () => (await import('../connect/identity/WhichBoard.tsx')).WhichBoard,
  '100%',
  'guards',
);

export function LivePanel() {
  const isAsked = useDevice(
    // Before the link is open there is nothing to ask about: a gateway may know the board.
    ({ family, way, snapshot: { link } }) =>
      family.id === 'unknown' && way !== null && link.status !== 'closed' && link.status !== 'opening',
  );
  return isAsked ? <WhichBoard /> : <ServosPanel />;
}
