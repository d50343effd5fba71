// How the copy on the board differs from the group at hand, as the board would get it now.

import { compareFrames } from '#shared/group/compareFrames.ts';
import type { SlotRecord } from '#shared/group/slotBook.ts';
import { servoName } from '../../profiles/servoName.ts';
import { useCompiled } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import styles from './Slots.module.css';

const SHOWN = 8;

export function Comparison({ record }: { readonly record: SlotRecord }) {
  const { frames, source } = useCompiled((state) => state.latest);
  const { isSame, frameCounts, durationsMs, firstDifferent, servos } = compareFrames(record.frames, frames);
  const [[boardFrames, hereFrames], [boardMs, hereMs]] = [frameCounts, durationsMs];
  const placeText = (position: number | null): string =>
    position === null ? words.slots.notMoved : words.numbers.formatWhole(position);
  return (
    <div className={styles.comparison} role="status">
      {isSame ? (
        <p>{words.slots.same}</p>
      ) : (
        <>
          <p>{words.slots.lengths({ boardFrames, boardMs, frames: hereFrames, ms: hereMs })}</p>
          {firstDifferent !== null && <p>{words.slots.firstDifferent({ frame: firstDifferent + 1 })}</p>}
          <ul>
            {servos.slice(0, SHOWN).map(({ servo, positions: [onBoard, here] }) => (
              <li key={servo}>
                {words.slots.differs({
                  ...{ name: servoName(source.robot, servo), onBoard: placeText(onBoard) },
                  here: placeText(here),
                })}
              </li>
            ))}
          </ul>
        </>
      )}
    </div>
  );
}
