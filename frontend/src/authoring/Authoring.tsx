// The authoring area: action group, poses, or keys and pad. It is one panel, whatever stands in it: the choice between them stays
// under the finger, and keeps the focus of the keys, that makes it.

import { FilesArea } from '../files/FilesArea.tsx';
import { useView } from '../stores/stores.ts';
import { later, Missing, usePart } from '../ui/later.tsx';
import { Panel, type PanelParts } from '../ui/Panel.tsx';
import { words } from '../words/words.ts';
import { AuthoringTabs } from './AuthoringTabs.tsx';
import styles from './Authoring.module.css';

const PARTS = {
  group: later(async () => (await import('../actions/ActionsPanel.tsx')).actionsParts),
  poses: later(async () => (await import('../poses/PosesPanel.tsx')).posesParts),
  pad: later(async () => (await import('../pad/PadPanel.tsx')).padParts),
} as const;

export function Authoring() {
  const authoring = useView((state) => state.authoring);
  const { part, isMissing } = usePart(PARTS[authoring]);
  if (part !== null) return <AuthoringPanel {...part} />;
  return (
    <FilesArea>
      <Panel title={words.authoring[authoring]} tabs={<AuthoringTabs />} className={styles.coming}>
        {isMissing && <Missing part={PARTS[authoring]} />}
      </Panel>
    </FilesArea>
  );
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
