// For hands without arrow keys: what is selected goes by the board's tick, or by one of what is shown. Seen only where fingers are.

import type { IconName } from '../../../ui/Icon.tsx';
import { useStores } from '../../stores.ts';
import { IconButton } from '../../../ui/Button.tsx';
import { words, type Words } from '../../../i18n/whole.ts';
import { deskOf } from './desk.ts';
import { selectedKeys } from './groupTimes.ts';
import { nudgeMarker } from './markers.ts';
import { nudge, servoAtHand } from './moving.ts';
import { turnText } from './positions.ts';
import type { SeenDesk } from './useDesk.ts';
import styles from './NudgeTools.module.css';

interface Step {
  readonly name: keyof Words['timeline']['nudges'];
  readonly icon: IconName;
  readonly ticks: number;
  readonly turns: number;
}

const STEPS: readonly Step[] = [
  { name: 'earlier', icon: 'earlier', ticks: -1, turns: 0 },
  { name: 'later', icon: 'later', ticks: 1, turns: 0 },
  { name: 'lower', icon: 'down', ticks: 0, turns: -1 },
  { name: 'higher', icon: 'up', ticks: 0, turns: 1 },
];

export function NudgeTools({ desk }: { readonly desk: SeenDesk }) {
  const stores = useStores();
  const { state, times, family } = desk;
  const hasMarker = state.marker !== null;
  const turn = turnText(desk, servoAtHand(desk, selectedKeys(times, state.selected)) ?? 0);
  return (
    <div className={styles.tools} role="group" aria-label={words.timeline.nudge}>
      {STEPS.map(({ name, icon, ticks, turns }) => (
        <IconButton
          key={name}
          icon={icon}
          label={words.timeline.nudges[name]({
            by: turns === 0 ? words.numbers.formatMs(family.motion.tickMs) : turn,
          })}
          isDisabled={hasMarker ? ticks === 0 : state.selected.size === 0}
          onPress={() =>
            hasMarker ? nudgeMarker(deskOf(stores), ticks) : nudge(deskOf(stores), ticks, turns)
          }
        />
      ))}
    </div>
  );
}
