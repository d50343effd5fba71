// Undo for any immutable value: references to the states before and after, each step with a label for people. A gesture is
// a transaction: begin, preview as often as needed, then commit as one step or cancel. Knows nothing of what it holds.

/** What a step is called, read whenever it is shown: its language may have changed since. */
export type Label = () => string;

/** Steps stored; with structural sharing 1,000 states of the largest group cost a few megabytes. */
const MAX_STEPS = 1000;

interface Step<T> {
  readonly label: Label;
  /** The value on the far side of the step. */
  readonly value: T;
}

export interface History<T> {
  readonly present: T;
  /** Oldest first: the last one is what Undo goes back to. */
  readonly past: readonly Step<T>[];
  /** Nearest last: the last one is what Redo goes to. */
  readonly future: readonly Step<T>[];
  /** The gesture in progress and the value it began from; `present` is its preview. */
  readonly gesture: Step<T> | null;
}

export function startHistory<T>(present: T): History<T> {
  return { present, past: [], future: [], gesture: null };
}

/** One finished edit. A gesture in progress is committed first: no edit may vanish when another one is cancelled. */
export function record<T>(history: History<T>, label: Label, next: T): History<T> {
  const settled = commit(history);
  return next === settled.present ? settled : step(settled, label, settled.present, next);
}

/** Starts a gesture; one already in progress is committed. */
export function begin<T>(history: History<T>, label: Label): History<T> {
  const settled = commit(history);
  return { ...settled, gesture: { label, value: settled.present } };
}

/** Shows a value of the gesture. Without a gesture nothing changes. */
export function preview<T>(history: History<T>, next: T): History<T> {
  return history.gesture === null || next === history.present ? history : { ...history, present: next };
}

/** Makes the gesture one step, or none if it changed nothing. */
export function commit<T>(history: History<T>): History<T> {
  const { gesture } = history;
  if (gesture === null) return history;
  const settled = { ...history, gesture: null };
  return gesture.value === history.present
    ? settled
    : step(settled, gesture.label, gesture.value, history.present);
}

/** What has happened elsewhere, as if it always had: no undo here reverts it. */
export function rebase<T>(history: History<T>, change: (value: T) => T): History<T> {
  const changed = (step: Step<T>): Step<T> => ({ ...step, value: change(step.value) });
  const { present, past, future, gesture } = history;
  return {
    present: change(present),
    past: past.map(changed),
    future: future.map(changed),
    gesture: gesture && changed(gesture),
  };
}

/** Forgets the gesture; the value is again what it was when the gesture began. */
export function cancel<T>(history: History<T>): History<T> {
  return history.gesture === null ? history : { ...history, present: history.gesture.value, gesture: null };
}

/** One step back; a gesture in progress is called off instead. */
export function undo<T>(history: History<T>): History<T> {
  if (history.gesture !== null) return cancel(history);
  const last = history.past.at(-1);
  if (last === undefined) return history;
  return {
    present: last.value,
    past: history.past.slice(0, -1),
    future: [...history.future, { label: last.label, value: history.present }],
    gesture: null,
  };
}

/** One step forward; not while a gesture is in progress. */
export function redo<T>(history: History<T>): History<T> {
  const next = history.future.at(-1);
  if (next === undefined || history.gesture !== null) return history;
  return {
    present: next.value,
    past: [...history.past, { label: next.label, value: history.present }],
    future: history.future.slice(0, -1),
    gesture: null,
  };
}

/** What Undo would take back; null where there is nothing. */
export function undoLabel(history: History<unknown>): string | null {
  return history.past.at(-1)?.label() ?? null;
}

export function redoLabel(history: History<unknown>): string | null {
  return history.future.at(-1)?.label() ?? null;
}

function step<T>(history: History<T>, label: Label, before: T, present: T): History<T> {
  const past = [...history.past, { label, value: before }].slice(-MAX_STEPS);
  return { present, past, future: [], gesture: null };
}

/** It is one of the states that lead here or on from here. The newest are looked at first. */
export function holds<T>({ present, past, future, gesture }: History<T>, value: T): boolean {
  const isIt = (step: Step<T>): boolean => step.value === value;
  return (
    present === value || gesture?.value === value || past.findLast(isIt) !== undefined || future.some(isIt)
  );
}
