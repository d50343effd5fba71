// A splitter of a workspace, whose size the browser remembers.

import type { CSSProperties } from 'react';
import { useStores, useView } from '../../features/stores.ts';
import type { Split as SplitName } from '../../features/view.ts';
import { words } from '../../i18n/words.ts';
import { Splitter } from '../../ui/Splitter.tsx';

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
