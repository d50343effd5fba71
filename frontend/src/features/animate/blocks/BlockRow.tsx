// The blocks of the group on a track above its keys: dragged or moved by the arrow keys, repeated by their right edge, and what is set of the
// one that is selected. A group without blocks has no such row.

import { memo, useState, type CSSProperties, type KeyboardEvent, type ReactNode } from 'react';
import {
  deleteBlock,
  duplicateBlock,
  levelsOf,
  setBlock,
  unpackBlock,
  type BlockChange,
} from '#shared/group/blockEdits.ts';
import { blockMs, blocksOf, endOfBlock } from '#shared/group/blocks.ts';
import { FASTEST_PERCENT, MOST_TIMES, SLOWEST_PERCENT, type Block } from '#shared/group/group.ts';
import { words } from '../../../i18n/whole.ts';
import { cx } from '../../../ui/cx.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { NameField } from '../../../ui/NameField.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { type Stores, useDocument, useStores, useTimeline } from '../../stores.ts';
import { xOf } from '../timeline/timeScale.ts';
import { useTimeDrag } from '../timeline/useTimeDrag.ts';
import { instantText } from '../timeline/valueText.ts';
import styles from './BlockRow.module.css';

/** `children`: what is drawn over it, as over the tracks. */
export const BlockRow = memo(function BlockRow({ children }: { readonly children: ReactNode }) {
  const blocks = useDocument(({ present }) => blocksOf(present));
  const [chosen, setChosen] = useState<number | null>(null);
  if (blocks.length === 0) return null;
  const block = blocks.find(({ id }) => id === chosen);
  const levels = levelsOf(blocks);
  const count = 1 + Math.max(...levels.values());
  return (
    <>
      <div className={styles.row} role="group" aria-label={words.blocks.row}>
        <div className={styles.head}>{words.blocks.row}</div>
        <div className={styles.track} style={{ '--levels': count } as CSSProperties}>
          {blocks.map((one) => (
            <BlockBar
              key={one.id}
              block={one}
              level={levels.get(one.id) ?? 0}
              isChosen={one.id === chosen}
              onChoose={() => setChosen(one.id === chosen ? null : one.id)}
            />
          ))}
          {children}
        </div>
      </div>
      {block !== undefined && <BlockSettings key={block.id} block={block} onClose={() => setChosen(null)} />}
    </>
  );
});

interface BlockBarProps {
  readonly block: Block;
  readonly level: number;
  readonly isChosen: boolean;
  onChoose(): void;
}

function BlockBar({ block, level, isChosen, onChoose }: BlockBarProps) {
  const { document, notices } = useStores();
  const time = useTimeline((state) => state.time);
  const { id, name, startMs, times } = block;
  const drag = useTimeDrag({
    startMs,
    label: () => words.blocks.steps.move,
    moved: (next) => (group) => setBlock(group, id, { startMs: next }),
    onBeats: true,
    onPress: onChoose,
    onStep: (next) => notices.say(words.blocks.startsAt({ name, at: instantText(Math.max(0, next)) })),
  });
  const width = blockMs(block) / time.msPerPx;
  const share = (ms: number): string => `${(100 * ms) / Math.max(1, blockMs(block))}%`;
  const place = { left: xOf(time, startMs), width, '--level': level } as CSSProperties;
  const blends = { '--in': share(block.blendInMs), '--out': share(block.blendOutMs) } as CSSProperties;

  function key(event: KeyboardEvent): void {
    if (event.key === 'Enter' || event.key === ' ') onChoose();
    else if (event.key === 'Delete' || event.key === 'Backspace') act(document, id, 'delete');
    else return drag.onKeyDown(event);
    event.preventDefault();
  }

  return (
    <div
      {...drag}
      role="button"
      tabIndex={0}
      className={cx(styles.block, isChosen && styles.chosen)}
      style={{ ...place, ...blends }}
      aria-pressed={isChosen}
      aria-label={words.blocks.about({
        ...{ name, from: instantText(startMs), to: instantText(endOfBlock(block)), times },
      })}
      onKeyDown={key}
    >
      <span className={styles.name}>{name}</span>
      {times > 1 && <span className={styles.times}>{words.blocks.times({ times })}</span>}
      <Edge block={block} />
    </div>
  );
}

const ACTS = { duplicate: duplicateBlock, unpack: unpackBlock, delete: deleteBlock } as const;

function act(document: Stores['document'], id: number, name: keyof typeof ACTS): void {
  document.edit(
    () => words.blocks.steps[name],
    (group) => ACTS[name](group, id),
  );
}

/** Dragged, it has the block repeated as often as there is room for. */
function Edge({ block }: { readonly block: Block }) {
  const once = { ...block, times: 1 };
  const twice = { ...block, times: 2 };
  const passMs = blockMs(twice) - blockMs(once);
  const timesAt = (endMs: number): number =>
    1 + Math.max(0, Math.round((endMs - endOfBlock(once)) / Math.max(1, passMs)));
  const { onKeyDown: _, ...drag } = useTimeDrag({
    startMs: endOfBlock(block),
    label: () => words.blocks.steps.change,
    rest: (wanted) => endOfBlock({ ...block, times: timesAt(wanted) }),
    moved: (endMs) => (group) => setBlock(group, block.id, { times: timesAt(endMs) }),
  });
  return (
    <span
      {...drag}
      className={styles.edge}
      onPointerDown={(event) => {
        event.stopPropagation();
        drag.onPointerDown(event);
      }}
    />
  );
}

interface FieldOf {
  readonly name: 'times' | 'speedPercent' | 'blendInMs' | 'blendOutMs';
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly unit: () => string;
}

const FIELDS: readonly FieldOf[] = [
  { name: 'times', min: 1, max: MOST_TIMES, step: 1, unit: () => '×' },
  { name: 'speedPercent', min: SLOWEST_PERCENT, max: FASTEST_PERCENT, step: 10, unit: () => '%' },
  { name: 'blendInMs', min: 0, max: 10_000, step: 100, unit: () => words.servos.ms },
  { name: 'blendOutMs', min: 0, max: 10_000, step: 100, unit: () => words.servos.ms },
];

function BlockSettings({ block, onClose }: { readonly block: Block; onClose(): void }) {
  const { document } = useStores();
  const { id, name } = block;
  const set = (change: BlockChange): void =>
    document.edit(
      () => words.blocks.steps.change,
      (group) => setBlock(group, id, change),
    );
  return (
    <div className={styles.settings} role="group" aria-label={words.blocks.settings({ name })}>
      <span className={styles.named}>
        <NameField
          isFramed
          label={words.blocks.name}
          name={name}
          onRename={(wanted) => set({ name: wanted })}
        />
      </span>
      {FIELDS.map(({ name: field, unit, ...range }) => (
        <label key={field} className={styles.field}>
          <span aria-hidden="true">{words.blocks.fields[field]}</span>
          <CheckedNumber
            label={words.blocks.fields[field]}
            value={block[field]}
            size="small"
            unit={unit()}
            {...range}
            onChange={(value) => set({ [field]: value })}
          />
        </label>
      ))}
      <span className={styles.acts}>
        <Button tone="quiet" icon="duplicate" onPress={() => act(document, id, 'duplicate')}>
          {words.blocks.duplicate}
        </Button>
        <Button tone="quiet" hint={words.blocks.unpackHint} onPress={() => act(document, id, 'unpack')}>
          {words.blocks.unpack}
        </Button>
        <IconButton icon="trash" label={words.blocks.delete} onPress={() => act(document, id, 'delete')} />
        <IconButton icon="close" label={words.close} onPress={onClose} />
      </span>
    </div>
  );
}
