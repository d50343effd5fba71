// The dialog of people and devices: an owner manages them and sees what happened, other people see and change their own name. Refreshes
// while it is open.

import { useEffect, useState } from 'react';
import { useStore } from 'zustand';
import { actsApi, createActs } from './acts.ts';
import { ActsView } from './ActsView.tsx';
import { managesPeople, titleFor } from './people.ts';
import { OwnView, PeopleView } from './PeopleView.tsx';
import { useSnapshot, useStores, useView } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { saveFile } from '../../ui/localFiles.tsx';
import { TabList, tabPanel } from '../../ui/TabList.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './People.module.css';

const LOOK_EACH_MS = 1500;
const LOOK_AT_ACTS_EACH_MS = 3000;

export function PeopleDialog() {
  const { people, view } = useStores();
  const isOpen = useView((state) => state.peopleOpen);
  const { me } = useStore(people.store);
  useRefreshing(people.refresh, LOOK_EACH_MS, isOpen);
  const close = (): void => {
    people.endInvitation();
    people.closeShown();
    view.setState({ peopleOpen: false });
  };
  return (
    <Dialog wide title={titleFor(me)} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      {managesPeople(me) ? <OwnersViews /> : <OwnView me={me} onRename={people.sayName} />}
    </Dialog>
  );
}

function useRefreshing(refresh: () => Promise<void>, everyMs: number, isWanted: boolean): void {
  useEffect(() => {
    if (!isWanted) return undefined;
    void refresh();
    const timer = setInterval(() => void refresh(), everyMs);
    return () => clearInterval(timer);
  }, [refresh, everyMs, isWanted]);
}

function OwnersViews() {
  const [tab, setTab] = useState<'people' | 'acts'>('people');
  return (
    <div className={styles.views}>
      <TabList<'people' | 'acts'>
        isLow
        label={words.acts.tabs}
        tabs={[
          { id: 'people', icon: 'people', name: words.acts.people },
          { id: 'acts', icon: 'log', name: words.acts.tab },
        ]}
        chosen={tab}
        onChoose={setTab}
      />
      <div {...tabPanel(tab)}>{tab === 'people' ? <PeopleOfGateway /> : <ActsOfGateway />}</div>
    </div>
  );
}

function PeopleOfGateway() {
  const { people, device } = useStores();
  const state = useStore(people.store);
  const candidates = useSnapshot(({ lease }) => lease?.candidates) ?? [];
  return (
    <PeopleView
      state={state}
      wishes={people}
      candidates={candidates}
      onHandOver={(grantTo) => device.lease({ grantTo })}
      now={device.clock.now}
    />
  );
}

function ActsOfGateway() {
  const { notices } = useStores();
  const [acts] = useState(() =>
    createActs(actsApi, () => notices.show('danger', words.people.problems.unreachable)),
  );
  useRefreshing(acts.refresh, LOOK_AT_ACTS_EACH_MS, true);
  async function save(): Promise<void> {
    const text = await acts.file();
    if (text !== null) saveFile({ name: `${words.acts.fileName}.csv`, text });
  }
  return (
    <ActsView
      state={useStore(acts.store)}
      onFilter={(filter) => void acts.setFilter(filter)}
      onOlder={() => void acts.showOlder()}
      onExport={() => void save()}
    />
  );
}
