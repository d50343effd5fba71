// What the workspaces of a wide screen share: the sliders (or the question which board it is), splitters whose size the browser remembers,
// and the choice of the workspace, in the bar of a desktop and at the foot of a tablet.

import type { CSSProperties } from 'react';
import { useStores, useView, useIsUnidentified } from '../../features/stores.ts';
import type { Split as SplitName } from '../../features/view.ts';
import { words } from '../../i18n/words.ts';
import { Splitter } from '../../ui/Splitter.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { ServosPanel } from '../../features/drive/ServosPanel.tsx';

interface SplitProps {
  readonly name: SplitName;
  readonly between: 'columns' | 'rows';
  readonly usual: number;
  readonly min: number;
  readonly max: number;
  readonly isBefore?: boolean;
}

export function Split({ name, ...rest }: SplitProps) {
  const { view } = useStores();
  const size = useView(({ splits }) => splits[name]) ?? null;
  return (
    <Splitter
      label={words.workspace.splits[name]}
      size={size}
      onSize={(wanted) =>
        view.setState(({ splits: { [name]: _, ...others } }) => ({
          splits: wanted === null ? others : { ...others, [name]: wanted },
        }))
      }
      {...rest}
    />
  );
}

/** The size as a property for CSS, which knows the usual one. */
export function sized(property: `--${string}`, size: number | undefined): CSSProperties {
  return size === undefined ? {} : { [property]: `${size}px` };
}

const WORKSPACES = ['live', 'actions', 'board', 'buttons'] as const;

/** The log is part of the board's workspace there. */
export function WorkspaceSwitch() {
  const { view } = useStores();
  const tab = useView((state) => state.tab);
  return (
    <Choice
      label={words.tabList}
      value={tab === 'log' ? 'board' : tab}
      options={WORKSPACES.map((value) => ({ value, label: words.tabs[value] }))}
      onChange={(chosen) => view.setState({ tab: chosen })}
    />
  );
}

const WhichBoard = laterComponent(
  async () => (await import('../../features/connect/identity/WhichBoard.tsx')).WhichBoard,
  '100%',
  'guards',
);

export function LivePanel(props: Parameters<typeof ServosPanel>[0]) {
  return useIsUnidentified() ? <WhichBoard /> : <ServosPanel {...props} />;
}
