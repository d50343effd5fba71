// A field in place: a number or a text that the timeline asks for, beside what it is about. Enter and leaving the field take it,
// Escape does not (and stops the robot, as everywhere).

import { useStores, useTimeline } from '../stores/stores.ts';
import { ALL_ROW, type Ask } from '../stores/timeline.ts';
import { words } from '../words/words.ts';
import { answer, ASKED } from './asks.ts';
import { deskOf, type Desk } from './desk.ts';
import { endOfFrame } from './groupTimes.ts';
import { sceneOf } from './scene.ts';
import { sizesNow } from './lanes.ts';
import { xOf } from './timeScale.ts';
import styles from './AskBox.module.css';

export function AskBox({ onClose }: { onClose(): void }) {
  const asks = useTimeline((state) => state.asks);
  return asks === null ? null : <Asked key={asks} ask={asks} onClose={onClose} />;
}

function Asked({ ask, onClose }: { readonly ask: Ask; onClose(): void }) {
  const stores = useStores();
  const desk = deskOf(stores);
  const asked = ASKED[ask];
  const close = (): void => {
    stores.timeline.setState({ asks: null });
    onClose();
  };
  const take = (text: string): void => {
    if (stores.timeline.getState().asks !== ask) return;
    close();
    const problem = answer(deskOf(stores), ask, text);
    if (problem !== null) stores.notices.tell('warning', problem);
  };
  return (
    <div className={styles.box} style={placeOf(desk)}>
      <input
        type="text"
        autoFocus
        className={asked.kind === 'text' ? styles.text : styles.number}
        inputMode={asked.kind === 'text' ? 'text' : 'numeric'}
        aria-label={words.timeline.asks[ask]}
        title={words.timeline.asks[ask]}
        autoComplete="off"
        maxLength={asked.kind === 'text' ? asked.maxLength : 8}
        defaultValue={asked.initial(desk)}
        onFocus={(event) => event.target.select()}
        onBlur={(event) => take(event.target.value)}
        onKeyDown={(event) => {
          if (event.key === 'Enter') take(event.currentTarget.value);
          if (event.key === 'Escape') close();
        }}
      />
      {asked.kind === 'number' && <span className={styles.unit}>{asked.unit(desk)}</span>}
    </div>
  );
}

/** Below what it is about, within the lanes. */
function placeOf(desk: Desk): { readonly insetInlineStart: string; readonly top: number } {
  const { state, times } = desk;
  const atMs = endOfFrame(times, state.cursor.frameId) ?? state.playheadMs;
  const scene = sceneOf(desk, sizesNow(state));
  const row = [scene.all, ...scene.rows].find(({ row: { id } }) => id === state.cursor.row) ?? scene.all;
  const x = Math.min(
    Math.max(8, xOf(state.time, state.asks === 'marker' ? state.playheadMs : atMs) + 10),
    state.widthPx - 150,
  );
  const top = state.cursor.row === ALL_ROW ? scene.all.top : row.top;
  return { insetInlineStart: `calc(var(--heads) + ${x}px)`, top: Math.min(top, state.heightPx - 44) };
}
