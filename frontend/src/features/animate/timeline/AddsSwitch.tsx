// For hands without a Ctrl key: what is pressed in the timeline or the strip goes beside what is selected. Stands with the tools of
// both; seen only where fingers are.

import { useStores, useView } from '../../stores.ts';
import { ToggleButton } from '../../../ui/ToggleButton.tsx';
import { words } from '../../../i18n/whole.ts';
import styles from './AddsSwitch.module.css';

export function AddsSwitch() {
  const { view } = useStores();
  const isOn = useView((state) => state.addsToSelection);
  return (
    <span className={styles.adds}>
      <ToggleButton isOn={isOn} onChange={(addsToSelection) => view.setState({ addsToSelection })}>
        {words.actions.adds}
      </ToggleButton>
    </span>
  );
}
