// The authoring area: action group, poses, or keys and pad. It is one panel, whatever stands in it: the choice between them stays
// under the finger, and keeps the focus of the keys, that makes it.

import { usePad, useStores, useView } from '../features/stores.ts';
import { Choice } from '../ui/Toggle.tsx';
import { words } from '../i18n/words.ts';
import { FilesArea } from '../features/library/files/FilesArea.tsx';
import type { ViewState } from '../features/view.ts';
import { later, Missing, usePart, type Later } from '../ui/later.tsx';
import { Panel, type PanelParts } from '../ui/Panel.tsx';
import styles from './Authoring.module.css';

// Which of the three is worked on beside the live robot. Stands where a panel's title would; driving goes on, and is
// said, whichever of them is open.

function AuthoringTabs() {
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

export function AuthoringPanel({ title, Note, Tools, Content, className }: PanelParts) {
  return (
    <FilesArea>
      <Panel
        title={title()}
        tabs={<AuthoringTabs />}
        note={Note !== undefined && <Note />}
        tools={<Tools />}
        className={className}
      >
        <Content />
      </Panel>
    </FilesArea>
  );
}
