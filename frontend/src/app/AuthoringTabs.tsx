// Which of the three is worked on beside the live robot. Stands where a panel's title would; driving goes on, and is said,
// whichever of them is open.

import { usePad, useStores, useView } from '../features/stores.ts';
import { Choice } from '../ui/Toggle.tsx';
import { words } from '../i18n/words.ts';

export function AuthoringTabs() {
  const { view } = useStores();
  const authoring = useView((state) => state.authoring);
  const isDriving = usePad((state) => state.isDriving);
  return (
    <Choice
      label={words.authoring.label}
      value={authoring}
      options={[
        { value: 'group', label: words.authoring.group },
        { value: 'poses', label: words.authoring.poses },
        { value: 'pad', label: isDriving ? words.authoring.padDriving : words.authoring.pad },
      ]}
      onChange={(chosen) => view.setState({ authoring: chosen })}
    />
  );
}
