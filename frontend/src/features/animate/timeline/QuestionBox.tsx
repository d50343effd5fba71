// A field in place: a number or a text that the timeline requests, beside what it is about. Enter and leaving the field take it,
// Escape does not (and stops the robot, as everywhere). Before it is requested, the value of the selected key stands there.
// That one opens by a mere click on a key, so until something is written in it the hand is still on the keys: what writes no
// number is for them.

import { useEffect, useRef, type KeyboardEvent } from 'react';
import { useStores, useTimeline } from '../../stores.ts';
import { type Ask, selectedKeys } from './timeline.ts';
import { cx } from '../../../ui/cx.ts';
import { isTouch } from '../../../ui/inputEvents.ts';
import { words } from '../../../i18n/whole.ts';
import { answer, QUESTIONS } from './questions.ts';
import { contextOf, rowRanges, type ShownContext, useTimelineContext } from './context.ts';
import { endOfFrame } from '#shared/group/groupTimes.ts';
import { sizesNow } from './trackCanvas.ts';
import { scaleAt } from './valueText.ts';
import { sceneOf } from './scene.ts';
import { xOf } from './timeScale.ts';
import styles from './QuestionBox.module.css';

export interface AskBoxProps {
  onClose(): void;
  /** The press is for the keys: the field has closed. */
  onPass(event: KeyboardEvent): void;
}

export function AskBox(props: AskBoxProps) {
  const question = useTimeline((state) => state.question);
  const hasOne = useTimeline(({ selected }) => selected.size === 1);
  if (question !== null) return <QuestionForm key={question} ask={question} {...props} />;
  return hasOne ? <KeyValue /> : null;
}

/** The cell of the key says it to ears. */
function KeyValue() {
  const context = useTimelineContext();
  const { times, state } = context;
  const [key] = selectedKeys(times, state.selected);
  if (key?.frameId !== state.cursor.frameId) return null;
  const place = placeOf(context);
  if (place === null) return null;
  return (
    <div className={cx(styles.box, styles.value)} style={place} aria-hidden="true">
      {scaleAt(context, key.servo).text(key.position)}
    </div>
  );
}

function QuestionForm({ ask, onClose, onPass }: AskBoxProps & { readonly ask: Ask }) {
  const stores = useStores();
  const place = placeOf(useTimelineContext());
  const context = contextOf(stores);
  const form = QUESTIONS[ask];
  const field = useRef<HTMLInputElement>(null);
  // Not sooner: as long as a menu is closing, nothing beside it takes the focus.
  useEffect(() => field.current?.focus(), []);
  const close = (): void => {
    stores.timeline.setState({ question: null, typed: '' });
    onClose();
  };
  const take = (text: string): void => {
    if (stores.timeline.getState().question !== ask) return;
    close();
    const problem = answer(contextOf(stores), ask, text);
    if (problem !== null) stores.notices.show('warning', problem);
  };
  /** A suggested number is taken by Enter alone; leaving the field cancels it. */
  const isLeftAlone = (text: string): boolean => form.kind === 'number' && text === form.initial(context);
  return (
    <div className={styles.box} style={place ?? {}}>
      <input
        ref={field}
        type="text"
        className={form.kind === 'text' ? styles.text : styles.number}
        inputMode={form.kind === 'text' ? 'text' : 'decimal'}
        aria-label={words.timeline.questions[ask]}
        title={ask === 'value' ? words.timeline.changes : words.timeline.questions[ask]}
        autoComplete="off"
        maxLength={form.kind === 'text' ? form.maxLength : 8}
        defaultValue={context.state.typed || form.initial(context)}
        onFocus={({ target }) => context.state.typed === '' && target.select()}
        onBlur={({ target }) => (isLeftAlone(target.value) ? close() : take(target.value))}
        onKeyDown={(event) => {
          if (event.key === 'Enter') take(event.currentTarget.value);
          if (event.key === 'Escape') close();
          if (ask !== 'value' || !isUntouched(event.currentTarget) || !isForKeys(event.key)) return;
          close();
          onPass(event);
        }}
      />
      {form.kind === 'number' && <span className={styles.unit}>{form.unit(context)}</span>}
    </div>
  );
}

/** All of it is selected, as when it opened: the person has not set the caret. */
function isUntouched({ value, defaultValue, selectionStart, selectionEnd }: HTMLInputElement): boolean {
  return value === defaultValue && selectionStart === 0 && selectionEnd === value.length;
}

const FOR_KEYS = /^(Arrow.+|Page.+|Delete|Backspace|ContextMenu|F10|[a-z ])$/i;

/** On a screen's keyboard Backspace is how a field is cleared. */
const isForKeys = (key: string): boolean => FOR_KEYS.test(key) && !(key === 'Backspace' && isTouch());

/** Beside what it is about, within the tracks. */
function placeOf(context: ShownContext): Place | null {
  const { state, times, stores } = context;
  const { playheadMs } = stores.timeline.getState();
  const isAtPlayhead = state.question === 'marker' || state.cursor.frameId === null;
  const atMs = isAtPlayhead ? playheadMs : (endOfFrame(times, state.cursor.frameId) ?? playheadMs);
  const scene = sceneOf(
    { ...context, state: { ...state, playheadMs } },
    sizesNow({ ...state, ranges: rowRanges(stores) }),
  );
  const row = [scene.all, ...scene.rows].find(({ row: { id } }) => id === state.cursor.row);
  if (row === undefined && state.question === null) return null;
  const x = xOf(state.time, atMs) + 10;
  if (state.question === null && (x < 0 || x > state.widthPx)) return null;
  return {
    insetInlineStart: `calc(var(--heads) + ${Math.min(Math.max(8, x), state.widthPx - (state.question === null ? 70 : 150))}px)`,
    top: Math.min((row ?? scene.all).top, state.heightPx - 44),
  };
}

interface Place {
  readonly insetInlineStart: string;
  readonly top: number;
}
