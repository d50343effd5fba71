// The authoring area: action group, poses, or keys and pad. It is one panel, whatever stands in it: the choice between them stays
// under the finger, and keeps the focus of the keys, that makes it.

import { actionsParts } from '../actions/ActionsPanel.tsx';
import { FilesArea } from '../files/FilesArea.tsx';
import { padParts } from '../pad/PadPanel.tsx';
import { posesParts } from '../poses/PosesPanel.tsx';
import { useView } from '../stores/stores.ts';
import { Panel, type PanelParts } from '../ui/Panel.tsx';
import { AuthoringTabs } from './AuthoringTabs.tsx';

const PARTS = { group: actionsParts, poses: posesParts, pad: padParts } as const;

export function Authoring() {
  return <AuthoringPanel {...PARTS[useView((state) => state.authoring)]} />;
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
