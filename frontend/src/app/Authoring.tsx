// The authoring area: action group, poses, or keys and pad. It is one panel, whatever stands in it: the choice between them stays
// under the finger, and keeps the focus of the keys, that makes it.

import { FilesArea } from '../features/library/files/FilesArea.tsx';
import type { ViewState } from '../features/view.ts';
import { useView } from '../features/stores.ts';
import { later, Missing, usePart, type Later } from '../ui/later.tsx';
import { Panel, type PanelParts } from '../ui/Panel.tsx';
import { words } from '../i18n/words.ts';
import { AuthoringTabs } from './AuthoringTabs.tsx';
import styles from './Authoring.module.css';

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
