// The person's buttons: large, for fingers, keys and children. One runs at a time.

import {
  type CSSProperties,
  type RefObject,
  useEffect,
  useEffectEvent,
  useLayoutEffect,
  useRef,
  useState,
} from 'react';
import { useStore } from 'zustand';
import { type Macro, keyOf, type MacroStep } from '#shared/profile/macro.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import type { MacroProgress } from './macroRun.ts';
import { poseName } from '../poses/poses.ts';
import { useDevice, usePoses, useStores, useMacros, useSnapshot } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { startHindrance } from '../../robot/readiness.ts';
import { cx } from '../../ui/cx.ts';
import styles from './Macros.module.css';

interface MacroFaceProps {
  readonly macro: Macro;
  readonly progress: MacroProgress | null;
}

/** The face of a button: its picture, name, key and first pose, or its progress. */
export function MacroFace({ macro, progress }: MacroFaceProps) {
  return (
    <>
      <Picture macro={macro} />
      <span className={styles.text}>
        <span className={styles.name}>{macro.name}</span>
        <span className={styles.about} role={progress === null ? undefined : 'status'}>
          {progress === null ? (
            <About {...macro} />
          ) : (
            words.macros.atWork({ step: progress.stepIndex + 1, count: progress.stepCount })
          )}
        </span>
      </span>
      {macro.key !== null && (
        <kbd className={styles.key} aria-hidden="true">
          {macro.key.toUpperCase()}
        </kbd>
      )}
      {progress !== null && <Steps {...progress} />}
    </>
  );
}

function About({ name, steps }: Macro) {
  const book = usePoses(({ present }) => present);
  const [first] = steps;
  if (first === undefined) return words.macros.empty;
  if (steps.length > 1) return words.macros.stepCount({ count: steps.length });
  const pose = first.kind === 'pose' ? poseName(book, first.pose) : '';
  // Most buttons have the name of their pose; then the pose is not named again.
  return stepText(first, pose === name ? '' : pose);
}

function Picture({ macro }: { readonly macro: Macro }) {
  const { poses } = useStores();
  const family = useDevice((state) => state.family);
  // Renders again when a pose changes.
  usePoses(({ present }) => present);
  const step = macro.steps.find(({ kind }) => kind === 'pose');
  const targets = step?.kind === 'pose' ? poses.targetsOf(step.pose) : null;
  if (targets === null) return null;
  return (
    <span className={styles.picture}>
      <PoseThumb
        pose={new Map(targets.map(({ servo, position }) => [servo, position]))}
        changed={[]}
        family={family}
      />
    </span>
  );
}

function Steps({ stepIndex, stepCount }: MacroProgress) {
  return (
    <span className={styles.steps} aria-hidden="true">
      {Array.from({ length: stepCount }, (_, index) => (
        <span key={index} data-done={index <= stepIndex} />
      ))}
    </span>
  );
}

/** Starts a button, or ends the one that is running. */
function useMacroPress(): (macro: Macro) => void {
  const { macroRun } = useStores();
  return (macro) => {
    if (macroRun.store.getState()?.macroId === macro.id) macroRun.end();
    else macroRun.start(macro);
  };
}

const TYPING =
  'input:not([type=radio], [type=checkbox], [type=range]), select, textarea, [role=dialog], [role=alertdialog]';

/**
 * Keys start buttons everywhere except in text fields and dialogs. A key counts once until it is released; when the window loses the
 * focus all keys count as released, because no keyup follows.
 */
function useMacroKeys(pressed: (key: string) => void): void {
  const press = useEffectEvent(pressed);
  useEffect(() => {
    const held = new Set<string>();
    const ended = new AbortController();
    const { signal } = ended;
    window.addEventListener('keydown', (event) => down(event, held, press), { signal });
    window.addEventListener('keyup', ({ key }) => held.delete(key.toLowerCase()), { signal });
    window.addEventListener('blur', () => held.clear(), { signal });
    return () => ended.abort();
  }, []);
}

function down(event: KeyboardEvent, held: Set<string>, press: (key: string) => void): void {
  const key = macroKey(event);
  const isTyping = event.target instanceof Element && event.target.closest(TYPING) !== null;
  if (key === null || isTyping || event.defaultPrevented || held.has(key)) return;
  held.add(key);
  press(key);
}

/** Wide enough for a picture beside a name. */
const BUTTON_RATIO = 1.7;
const LEAST_BUTTON_PX = 160;

/** With so many columns the buttons that share this room are largest. */
export function columnsFor(
  count: number,
  { width, height }: { readonly width: number; readonly height: number },
) {
  const sizeWith = (columns: number): number =>
    Math.min(width / columns / BUTTON_RATIO, height / Math.ceil(count / columns));
  return Array.from({ length: count }, (_, index) => index + 1)
    .filter((columns) => columns === 1 || width / columns >= LEAST_BUTTON_PX)
    .reduce((best, columns) => (sizeWith(columns) > sizeWith(best) ? columns : best), 1);
}

/** 0: they are as large as elsewhere. */
function useColumns(list: RefObject<HTMLElement | null>, count: number, fills: boolean): number {
  const [columns, setColumns] = useState(0);
  useLayoutEffect(() => {
    const element = list.current;
    if (element === null || !fills) return undefined;
    const measure = (): void =>
      setColumns(columnsFor(count, { width: element.clientWidth, height: element.clientHeight }));
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [list, count, fills]);
  return fills ? columns : 0;
}

/** `fills`: the buttons are as large as there is room for. */
export function MacroGrid({ fills = false }: { readonly fills?: boolean }) {
  const macros = useMacros(({ present }) => present.macros);
  const list = useRef<HTMLUListElement>(null);
  const columns = useColumns(list, macros.length, fills);
  const press = useMacroPress();
  useMacroKeys((key) => {
    const macro = macros.find((one) => one.key === key);
    if (macro !== undefined) press(macro);
  });
  return (
    <ul
      ref={list}
      className={cx(styles.grid, columns > 0 && styles.filling)}
      style={{ '--columns': columns } as CSSProperties}
      aria-label={words.macros.list}
    >
      {macros.map((macro) => (
        <li key={macro.id}>
          <MacroButton macro={macro} onPress={() => press(macro)} />
        </li>
      ))}
    </ul>
  );
}

function MacroButton({ macro, onPress }: { readonly macro: Macro; readonly onPress: () => void }) {
  const { macroRun } = useStores();
  const progress = useStore(macroRun.store);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const isAtWork = progress?.macroId === macro.id;
  const isWaiting = !isAtWork && (progress !== null || !mayStart);
  return (
    <button
      type="button"
      className={styles.button}
      data-colour={macro.colour}
      data-at-work={isAtWork}
      aria-label={nameAndKey(macro)}
      aria-pressed={isAtWork}
      aria-disabled={isWaiting}
      {...(macro.key !== null && { 'aria-keyshortcuts': macro.key.toUpperCase() })}
      onClick={onPress}
    >
      <MacroFace macro={macro} progress={isAtWork ? progress : null} />
    </button>
  );
}

type Pressed = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'repeat'>;

/** The key that may start a button; null with a modifier and for repeats. */
export function macroKey({ key, ctrlKey, metaKey, altKey, repeat }: Pressed): string | null {
  return ctrlKey || metaKey || altKey || repeat ? null : keyOf(key);
}

export function nameAndKey({ name, key }: Pick<Macro, 'name' | 'key'>): string {
  return key === null ? name : words.macros.keyed({ name, key: key.toUpperCase() });
}

/** What a step does in a few words. `pose`: the name of its pose, empty if the button has the same name. */
function stepText(step: MacroStep, pose: string): string {
  if (step.kind === 'slot') return words.macros.aboutSlot(step);
  if (step.kind === 'wait') return words.macros.aboutWait(step);
  const { durationMs } = step;
  return pose === '' ? words.numbers.formatMs(durationMs) : words.macros.aboutPose({ pose, durationMs });
}
