// One line that says where what is dragged is by now, what keys and pointer do right now, and what is selected.

import { memo } from 'react';
import type { IconName } from '../../../ui/Icon.tsx';
import { useStores, useServoView, editServoView } from '../../stores.ts';
import { IconButton, Button } from '../../../ui/Button.tsx';
import { words, type Words } from '../../../i18n/whole.ts';
import { deskOf, changeable, whyHeld } from './desk.ts';
import { selectedKeys } from './groupTimes.ts';
import { nudgeMarker, selectedMarker } from './markers.ts';
import { nudge, servoAtHand } from './moving.ts';
import { turnText, instantText, cellName } from './told.ts';
import { type SeenDesk, useDesk } from './useDesk.ts';
import { LiveText } from '../../../ui/LiveText.tsx';
import { isTouch } from '../../../ui/touch.ts';
import { READABLE_MS } from '../../../ui/useEachFrame.ts';
import type { StatusName } from './gesture.ts';
import { servoRowId } from './rows.ts';
import nudgeToolsStyles from './NudgeTools.module.css';
import styles from './StatusText.module.css';

// For hands without arrow keys: what is selected goes by the board's tick, or by one of what is shown. Seen only
// where fingers are.

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

function NudgeTools({ desk }: { readonly desk: SeenDesk }) {
  const stores = useStores();
  const { state, times, family } = desk;
  const hasMarker = state.marker !== null;
  const turn = turnText(desk, servoAtHand(desk, selectedKeys(times, state.selected)) ?? 0);
  return (
    <div className={nudgeToolsStyles.tools} role="group" aria-label={words.timeline.nudge}>
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

export interface Said {
  readonly status: StatusName | null;
  readonly tells: (() => string) | undefined;
}

export const StatusText = memo(function StatusText({ status, tells }: Said) {
  const desk = useDesk();
  const stores = useStores();
  const hidden = useServoView((view) => view.hidden.length);
  return (
    <div className={styles.line}>
      <p className={styles.text}>
        {tells !== undefined && <LiveText className={styles.dragged} text={tells} eachMs={READABLE_MS} />}
        {textOf(desk, status)}
      </p>
      {isTouch() && <NudgeTools desk={desk} />}
      {hidden > 0 && (
        <Button tone="quiet" onPress={() => editServoView(stores, (view) => ({ ...view, hidden: [] }))}>
          {words.timeline.rows.showHidden({ count: hidden })}
        </Button>
      )}
    </div>
  );
});

/** Fingers hold no keys down. */
const ABOUT_KEYS = new Set<StatusName>(['move', 'box', 'scrub', 'duration', 'stretch', 'stretchBack']);

function textOf(desk: SeenDesk, status: StatusName | null): string {
  const { state, family } = desk;
  if (status !== null && status !== 'selected' && status !== 'nothing')
    return isTouch() && ABOUT_KEYS.has(status) ? '' : words.timeline.status[status];
  const marker = selectedMarker(desk);
  if (marker !== undefined) {
    const about = words.timeline.draggedMarker({ text: marker.text, at: instantText(marker.atMs) });
    return isTouch()
      ? words.timeline.byTouch.marker({ about })
      : words.timeline.markerSelected({ about, tickMs: family.motion.tickMs });
  }
  const keys = selectedKeys(desk.times, state.selected);
  const servo = servoAtHand(desk, keys);
  const [only] = keys;
  if (only === undefined || servo === undefined)
    return isTouch() ? words.timeline.byTouch.nothing : words.timeline.status.nothing;
  if (changeable(desk).length === 0) return words.timeline.held[whyHeld(desk)];
  const about =
    keys.length === 1
      ? cellName(desk, { row: servoRowId(servo), frameId: only.frameId })
      : words.timeline.keys({ count: keys.length });
  if (isTouch()) return words.timeline.byTouch.selected({ about });
  return words.timeline.status.selected({ about, tickMs: family.motion.tickMs, turn: turnText(desk, servo) });
}
