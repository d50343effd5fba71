// The place of live control: the servos, or, on a board that is not identified, the question which one it is.

import { useIsUnidentified } from '../features/stores.ts';
import { laterComponent } from '../ui/later.tsx';
import { ServosPanel } from '../features/drive/ServosPanel.tsx';

const WhichBoard = laterComponent(
  async () => (await import('../features/connect/identity/WhichBoard.tsx')).WhichBoard,
  '100%',
  'guards',
);

export function LivePanel(props: Parameters<typeof ServosPanel>[0]) {
  return useIsUnidentified() ? <WhichBoard /> : <ServosPanel {...props} />;
}
