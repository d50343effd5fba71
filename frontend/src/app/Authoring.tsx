// The authoring area: action group, poses, or keys and pad; and what stands below the robot in Drive, which is one of the latter two.
// It is one panel, whatever stands in it: the choice between them stays under the finger, and keeps the focus of the keys, that makes it.

import type { ReactNode } from 'react';
import { usePad, useStores, useView } from '../features/stores.ts';
import { Choice } from '../ui/Toggle.tsx';
import { words } from '../i18n/words.ts';
import { FilesArea } from '../features/library/files/FilesArea.tsx';
import type { ViewState } from '../features/view.ts';
import { later, Missing, usePart, type Later } from '../ui/later.tsx';
import { Panel, type PanelParts } from '../ui/Panel.tsx';
import { Button, IconButton } from '../ui/Button.tsx';
import { cx } from '../ui/cx.ts';
import { PART } from '../ui/focus.ts';
import { useLayout } from '../ui/useLayout.ts';
import panel from '../ui/Panel.module.css';
import styles from './Authoring.module.css';

/** Stands where a panel's title would; driving continues, and is shown, whichever of them is open. */
function AuthoringTabs() {
  const { view } = useStores();
  const authoring = useView((state) => state.authoring);
  const isDriving = usePad((state) => state.isDriving);
  return (
    <>
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
      <WidthButton />
    </>
  );
}

/** The robot above the timeline leaves room for its rows, but not for the cards as well. */
function WidthButton() {
  const { view } = useStores();
  const isFull = useView(({ animateWith }) => animateWith === 'robot');
  if (useLayout() !== 'desktop') return null;
  return (
    <IconButton
      icon={isFull ? 'tune' : 'width'}
      label={isFull ? words.authoring.besideSliders : words.authoring.fullWidth}
      onPress={() =>
        view.setState(
          isFull
            ? { animateWith: 'sliders', frameCards: 'shown' }
            : { animateWith: 'robot', frameCards: 'folded' },
        )
      }
    />
  );
}

type Name = ViewState['authoring'];

const PARTS: Readonly<Record<Name, ComingParts>> = {
  group: coming(
    'group',
    async () => (await import('../features/animate/frames/ActionsPanel.tsx')).actionsParts,
  ),
  poses: coming('poses', async () => (await import('../features/poses/PosesPanel.tsx')).posesParts),
  pad: coming('pad', async () => (await import('../features/inputs/PadPanel.tsx')).padParts),
};

interface ComingParts {
  readonly whole: Later<PanelParts>;
  /** What stands there until it has come. */
  readonly until: PanelParts;
}

function coming(name: Name, load: () => Promise<PanelParts>): ComingParts {
  const whole = later(load);
  return {
    whole,
    until: {
      title: () => words.authoring[name],
      Tools: () => null,
      Content: () => usePart(whole).isMissing && <Missing part={whole} />,
      className: styles.coming,
    },
  };
}

export function Authoring() {
  const { whole, until } = PARTS[useView((state) => state.authoring)];
  return <AuthoringPanel {...(usePart(whole).part ?? until)} />;
}

/** Folded to its buttons while neither is open. */
export function BelowRobot() {
  const below = useView((state) => state.driveBelow);
  return below === 'none' ? (
    <section {...PART} className={cx(panel.panel, styles.folded)} aria-label={words.workspace.below}>
      <BelowTabs />
    </section>
  ) : (
    <OpenBelow name={below} />
  );
}

function OpenBelow({ name }: { readonly name: 'poses' | 'pad' }) {
  const { whole, until } = PARTS[name];
  return <AuthoringPanel {...(usePart(whole).part ?? until)} tabs={<BelowTabs />} />;
}

/** The one that is open closes. */
function BelowTabs() {
  const { view } = useStores();
  const below = useView((state) => state.driveBelow);
  const isDriving = usePad((state) => state.isDriving);
  const names = {
    poses: words.authoring.poses,
    pad: isDriving ? words.authoring.padDriving : words.authoring.pad,
  };
  return (
    <div className={styles.below} role="group" aria-label={words.workspace.below}>
      {(['poses', 'pad'] as const).map((name) => (
        <Button
          key={name}
          tone={name === below ? 'plain' : 'quiet'}
          icon={name === below ? 'down' : 'up'}
          aria-expanded={name === below}
          onPress={() => view.setState({ driveBelow: name === below ? 'none' : name })}
        >
          {names[name]}
        </Button>
      ))}
    </div>
  );
}

export function AuthoringPanel({
  title,
  tabs = <AuthoringTabs />,
  Note,
  Tools,
  Content,
  className,
}: PanelParts & { readonly tabs?: ReactNode }) {
  return (
    <FilesArea>
      <Panel
        title={title()}
        tabs={tabs}
        note={Note !== undefined && <Note />}
        tools={<Tools />}
        className={className}
      >
        <Content />
      </Panel>
    </FilesArea>
  );
}
