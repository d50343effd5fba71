// One line that says where what is dragged is by now, what keys and pointer do right now, and what is selected.

import { memo } from 'react';
import type { IconName } from '../../../ui/Icon.tsx';
import { useStores, useServoView, editServoView } from '../../stores.ts';
import { IconButton, Button } from '../../../ui/Button.tsx';
import { words, type Words } from '../../../i18n/whole.ts';
import { changeable, contextOf, type ShownContext, useTimelineContext, whyHeld } from './context.ts';
import { selectedKeys } from './timeline.ts';
import { currentServo, nudge, nudgeMarker, selectedMarker } from './moving.ts';
import { turnText, instantText, cellName } from './valueText.ts';
import { LiveText } from '../../../ui/LiveText.tsx';
import { isTouch } from '../../../ui/inputEvents.ts';
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
  readonly valueSteps: number;
}

const STEPS: readonly Step[] = [
  { name: 'earlier', icon: 'earlier', ticks: -1, valueSteps: 0 },
  { name: 'later', icon: 'later', ticks: 1, valueSteps: 0 },
  { name: 'lower', icon: 'down', ticks: 0, valueSteps: -1 },
  { name: 'higher', icon: 'up', ticks: 0, valueSteps: 1 },
];

function NudgeTools({ context }: { readonly context: ShownContext }) {
  const stores = useStores();
  const { state, times, family } = context;
  const hasMarker = state.marker !== null;
  const turn = turnText(context, currentServo(context, selectedKeys(times, state.selected)) ?? 0);
  return (
    <div className={nudgeToolsStyles.tools} role="group" aria-label={words.timeline.nudge}>
      {STEPS.map(({ name, icon, ticks, valueSteps }) => (
        <IconButton
          key={name}
          icon={icon}
          label={words.timeline.nudges[name]({
            by: valueSteps === 0 ? words.numbers.formatMs(family.motion.tickMs) : turn,
          })}
          isDisabled={hasMarker ? ticks === 0 : state.selected.size === 0}
          onPress={() =>
            hasMarker ? nudgeMarker(contextOf(stores), ticks) : nudge(contextOf(stores), ticks, valueSteps)
          }
        />
      ))}
    </div>
  );
}

export interface Said {
  readonly status: StatusName | null;
  readonly describe: (() => string) | undefined;
}

export const StatusText = memo(function StatusText({ status, describe }: Said) {
  const context = useTimelineContext();
  const stores = useStores();
  const hidden = useServoView((view) => view.hidden.length);
  return (
    <div className={styles.line}>
      <p className={styles.text}>
        {describe !== undefined && (
          <LiveText className={styles.dragged} text={describe} eachMs={READABLE_MS} />
        )}
        {textOf(context, status)}
      </p>
      {isTouch() && <NudgeTools context={context} />}
      {hidden > 0 && (
        <Button tone="quiet" onPress={() => editServoView(stores, (view) => ({ ...view, hidden: [] }))}>
          {words.timeline.rows.showHidden({ count: hidden })}
        </Button>
      )}
    </div>
  );
});

/** Fingers hold no keys down. */
const ABOUT_KEYS = new Set<StatusName>([
  'move',
  'box',
  'scrub',
  'duration',
  'stretch',
  'stretchBack',
  'curve',
]);

function textOf(context: ShownContext, status: StatusName | null): string {
  const { state, family } = context;
  if (status !== null && status !== 'selected' && status !== 'nothing')
    return isTouch() && ABOUT_KEYS.has(status) ? '' : words.timeline.status[status];
  const marker = selectedMarker(context);
  if (marker !== undefined) {
    const about = words.timeline.draggedMarker({ text: marker.text, at: instantText(marker.atMs) });
    return isTouch()
      ? words.timeline.byTouch.marker({ about })
      : words.timeline.markerSelected({ about, tickMs: family.motion.tickMs });
  }
  const keys = selectedKeys(context.times, state.selected);
  const servo = currentServo(context, keys);
  const [only] = keys;
  if (only === undefined || servo === undefined)
    return isTouch() ? words.timeline.byTouch.nothing : words.timeline.status.nothing;
  if (changeable(context).length === 0) return words.timeline.held[whyHeld(context)];
  const about =
    keys.length === 1
      ? cellName(context, { row: servoRowId(servo), frameId: only.frameId })
      : words.timeline.keys({ count: keys.length });
  if (isTouch()) return words.timeline.byTouch.selected({ about });
  return words.timeline.status.selected({
    about,
    tickMs: family.motion.tickMs,
    turn: turnText(context, servo),
  });
}
