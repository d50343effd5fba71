// Which of the two is being written: the action group or the poses. Stands where a panel's title would.

import { useStores, useView } from '../stores/stores.ts';
import { Choice } from '../ui/Toggle.tsx';
import { words } from '../words/en.ts';

export function AuthoringTabs() {
  const { view } = useStores();
  const authoring = useView((state) => state.authoring);
  return (
    <Choice
      label={words.poses.authoring.label}
      value={authoring}
      options={OPTIONS}
      onChange={(chosen) => view.setState({ authoring: chosen })}
    />
  );
}

const OPTIONS = [
  { value: 'group', label: words.poses.authoring.group },
  { value: 'poses', label: words.poses.authoring.poses },
] as const;
