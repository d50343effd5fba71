// From the controls to the page of buttons and back, where the screen has no tabs for it.

import { useStores, useView } from '../stores.ts';
import { Choice } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/words.ts';

export function PageSwitch() {
  const { view } = useStores();
  const isButtons = useView((state) => state.tab === 'buttons');
  return (
    <Choice
      label={words.macros.page.label}
      value={isButtons ? 'buttons' : 'work'}
      options={(['work', 'buttons'] as const).map((value) => ({ value, label: words.macros.page[value] }))}
      onChange={(page) => view.setState({ tab: page === 'buttons' ? 'buttons' : 'live' })}
    />
  );
}
