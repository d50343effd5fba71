// Puts the panels together for the size of the window: side by side on a desktop, stacked on a tablet, one at a time on a
// phone. STOP stands outside of all of them.

import { useEffect, useLayoutEffect, useRef, type UIEvent } from 'react';
import { useStore } from 'zustand';
import { useBatteryTab } from '../features/battery/BatteryReadout.tsx';
import { motionsInFrame } from '../features/picture/motion.ts';
import { ConnectDialog, ActionsDialog, LibraryDialog, PeopleDialog, ReplaceDialog } from './dialogs.tsx';
import type { Page } from './page.ts';
import { LogPanel, Messages } from '../features/log/Messages.tsx';
import { FilesProvider } from '../features/library/files/FilesArea.tsx';
import { TakeDialog } from '../features/animate/play/TakeDialog.tsx';
import { RobotDialog } from '../features/profiles/RobotDialog.tsx';
import { Authoring } from './Authoring.tsx';
import { usePageKeys } from './pageActions.ts';
import { LivePanel, WorkspaceSwitch } from './workspaces/parts.tsx';
import { DriveWork } from './workspaces/DriveWork.tsx';
import { StopButton } from '../features/drive/StopButton.tsx';
import { StoresContext, useStores, useView } from '../features/stores.ts';
import type { Tab as TabName, Theme } from '../features/view.ts';
import { TopBar } from './TopBar.tsx';
import { Hints } from '../ui/Hints.tsx';
import type { IconName } from '../ui/Icon.tsx';
import { fetchRest, laterComponent } from '../ui/later.tsx';
import { TabList, tabPanel } from '../ui/TabList.tsx';
import { useEachFrame } from '../ui/useEachFrame.ts';
import { useFocusRestored, useNoPasteByMouse, useParts } from '../ui/focus.ts';
import { useLayout } from '../ui/useLayout.ts';
import { useSpokenLocale, words } from '../i18n/words.ts';
import styles from './App.module.css';

const ButtonsPage = laterComponent(
  async () => (await import('../features/buttons/ButtonsPage.tsx')).ButtonsPage,
  '100%',
);
const AnimateWork = laterComponent(
  async () => (await import('./workspaces/AnimateAndBoard.tsx')).AnimateWork,
  '100%',
);
const BoardWork = laterComponent(
  async () => (await import('./workspaces/AnimateAndBoard.tsx')).BoardWork,
  '100%',
);
const BoardPanel = laterComponent(
  async () => (await import('../features/board/BoardPanel.tsx')).BoardPanel,
  '240px',
);
const BatteryPanel = laterComponent(
  async () => (await import('../features/battery/BatteryPanel.tsx')).BatteryPanel,
  '200px',
);
const CompileRow = laterComponent(
  async () => (await import('../features/animate/group/CompileRow.tsx')).CompileRow,
  'var(--control)',
);
const LogDrawer = laterComponent(
  async () => (await import('../features/log/LogDrawer.tsx')).LogDrawer,
  'var(--control)',
);
const CaptureStrip = laterComponent(
  async () => (await import('../features/animate/frames/CaptureButton.tsx')).CaptureStrip,
  'calc(var(--control) + var(--s2))',
);
const Kiosk = laterComponent(async () => (await import('./Kiosk.tsx')).Kiosk, '100%');

export function App({ page }: { readonly page: Page }) {
  useSpokenLocale();
  return (
    <StoresContext value={page.stores}>
      <FilesProvider>
        <Dashboard page={page} />
      </FilesProvider>
    </StoresContext>
  );
}

function Dashboard({ page }: { readonly page: Page }) {
  const layout = useLayout();
  const { notices } = useStores();
  const isKiosk = useView((state) => state.kiosk === 'on');
  const moveHere = (): void => void page.connector.moveHere().catch(notices.showError);
  return (
    <div className={styles.app} data-layout={layout}>
      <Unseen />
      {!isKiosk && <TopBar onMoveHere={moveHere} />}
      <StopButton />
      {isKiosk ? (
        <Kiosk onMoveHere={moveHere} />
      ) : layout === 'phone' ? (
        <PhoneWork />
      ) : (
        <WideWork isTablet={layout === 'tablet'} />
      )}
      <Said />
      <ConnectDialog connector={page.connector} />
      <RobotDialog />
      <LibraryDialog />
      <ReplaceDialog />
      {!isKiosk && <TakeDialog />}
      {!isKiosk && <ActionsDialog />}
      <PeopleDialog />
      <Hints />
    </div>
  );
}

/** Work that continues in every view. On its own: all below a component that listens to something is drawn again when that changes. */
function Unseen() {
  const stores = useStores();
  const { device, pad, playback } = stores;
  useTheme();
  useBatteryTab();
  usePageKeys(stores);
  useFocusRestored();
  useNoPasteByMouse();
  useParts();
  useEffect(() => void fetchRest(whenIdle), []);
  useEachFrame(() => {
    device.refresh(motionsInFrame(device));
    pad.frame();
    playback.frame();
  });
  return null;
}

const REST_MS = 400;

/** Not every browser says when it has nothing to do. */
const whenIdle = (): Promise<void> =>
  new Promise((resolve) => {
    setTimeout(
      () => ('requestIdleCallback' in window ? requestIdleCallback(() => resolve()) : resolve()),
      REST_MS,
    );
  });

const WORKSPACES = { live: DriveWork, actions: AnimateWork, board: BoardWork, buttons: ButtonsWork };

function WideWork({ isTablet }: { readonly isTablet: boolean }) {
  const tab = useView((state) => state.tab);
  const workspace = tab === 'log' ? 'board' : tab;
  const Workspace = WORKSPACES[workspace];
  return (
    <>
      <Workspace />
      <div className={styles.foot}>
        {isTablet && (
          <nav className={styles.switch} aria-label={words.tabList}>
            <WorkspaceSwitch />
          </nav>
        )}
        {workspace === 'actions' && <LogDrawer />}
        <Messages />
      </div>
    </>
  );
}

function ButtonsWork() {
  return (
    <main className={styles.page}>
      <ButtonsPage />
    </main>
  );
}

const TABS: readonly { readonly id: TabName; readonly icon: IconName }[] = [
  { id: 'live', icon: 'live' },
  { id: 'actions', icon: 'frames' },
  { id: 'board', icon: 'board' },
  { id: 'log', icon: 'log' },
  { id: 'buttons', icon: 'buttons' },
];

function PhoneWork() {
  const { view } = useStores();
  const tab = useView((state) => state.tab);
  return (
    <div className={styles.tabs}>
      <nav className={styles.tabBar} aria-label={words.tabList}>
        <TabList
          label={words.tabList}
          tabs={TABS.map((one) => ({ ...one, name: words.tabs[one.id] }))}
          chosen={tab}
          onChoose={(id) => view.setState({ tab: id })}
        />
      </nav>
      {tab === 'live' && <CaptureStrip />}
      <Messages />
      <main {...useOwnPlace(tab)} className={styles.phone}>
        <div key={tab} {...tabPanel(tab)} className={styles.tabPanel}>
          <PhonePanel tab={tab} />
        </div>
      </main>
    </div>
  );
}

function PhonePanel({ tab }: { readonly tab: TabName }) {
  if (tab === 'live') return <LivePanel />;
  if (tab === 'actions') return <Authoring />;
  if (tab === 'log') return <LogPanel />;
  if (tab === 'buttons') return <ButtonsPage />;
  return (
    <>
      <BoardPanel fit={<CompileRow />} />
      <BatteryPanel />
    </>
  );
}

/** Each tab is found as far down as it was left, a new one at its top. */
function useOwnPlace(tab: TabName) {
  const ref = useRef<HTMLElement>(null);
  const places = useRef(new Map<TabName, number>());
  useLayoutEffect(() => {
    if (ref.current !== null) ref.current.scrollTop = places.current.get(tab) ?? 0;
  }, [tab]);
  const onScroll = (event: UIEvent<HTMLElement>): void =>
    void places.current.set(tab, event.currentTarget.scrollTop);
  return { ref, onScroll };
}

function Said() {
  const said = useStore(useStores().notices.said);
  return (
    <p className={styles.said} role="status">
      {said}
    </p>
  );
}

function useTheme(): void {
  const theme: Theme = useView((state) => state.theme);
  useEffect(() => {
    if (theme === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
  }, [theme]);
}
