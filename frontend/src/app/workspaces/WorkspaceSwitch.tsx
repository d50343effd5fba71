// Which workspace a wide screen shows: in the bar of a desktop, and at the foot of a tablet, under the thumb. A phone has tabs.

import { useStores, useView } from '../../features/stores.ts';
import { words } from '../../i18n/words.ts';
import { Choice } from '../../ui/Toggle.tsx';

const WORKSPACES = ['live', 'actions', 'board', 'buttons'] as const;

/** The log is part of the board's workspace there. */
export function WorkspaceSwitch() {
  const { view } = useStores();
  const tab = useView((state) => state.tab);
  return (
    <Choice
      label={words.tabList}
      value={tab === 'log' ? 'board' : tab}
      options={WORKSPACES.map((value) => ({ value, label: words.tabs[value] }))}
      onChange={(chosen) => view.setState({ tab: chosen })}
    />
  );
}
