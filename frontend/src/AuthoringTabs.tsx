// What is worked on beside the live robot, one at a time. Driving goes on, and is said, whichever of them is open.

import { Tab, TabList, TabPanel, Tabs } from 'react-aria-components/Tabs';
import { ActionsPanel } from './actions/ActionsPanel.tsx';
import { PadPanel } from './pad/PadPanel.tsx';
import { usePad, useStores, useView } from './stores/stores.ts';
import type { ViewState } from './stores/view.ts';
import { words } from './words/en.ts';
import styles from './AuthoringTabs.module.css';

export function AuthoringTabs() {
  const { view } = useStores();
  const shown = useView((state) => state.authoring);
  const isDriving = usePad((state) => state.isDriving);
  return (
    <Tabs
      className={styles.tabs ?? ''}
      selectedKey={shown}
      onSelectionChange={(key) => view.setState({ authoring: key as ViewState['authoring'] })}
    >
      <TabList className={styles.list ?? ''} aria-label={words.pad.tabList}>
        <Tab id="group" className={styles.tab ?? ''}>
          {words.pad.tabs.group}
        </Tab>
        <Tab id="pad" className={styles.tab ?? ''}>
          {isDriving ? words.pad.drivingTab : words.pad.tabs.pad}
        </Tab>
      </TabList>
      <TabPanel id="group" className={styles.panel ?? ''}>
        <ActionsPanel />
      </TabPanel>
      <TabPanel id="pad" className={styles.panel ?? ''}>
        <PadPanel />
      </TabPanel>
    </Tabs>
  );
}
