// The actions of the frames and the keys of their strip. Tools, keys and the list of all actions are made from these.

import { indexOfFrame, setTargets } from '#shared/group/groupEdits.ts';
import { freeOf, stayingOf } from '../../servoView.ts';
import { motionHindrance, tellsPositions } from '../../../robot/readiness.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { knownFamily } from '../../groupDocument.ts';
import { runByKey, type Action, type KeyUse, type Pressed } from '../../../ui/action.ts';
import { neighbour, cardActions, walkKeys } from '../../../ui/cards.ts';
import type { TimelineStores } from '../timeline/context.ts';
import { spanFrames } from '../timeline/inStep.ts';
import { words } from '../../../i18n/whole.ts';
import { captureFrame } from './CaptureButton.tsx';
import {
  copy,
  cut,
  duplicate,
  moveBy,
  paste,
  removeFrames,
  selectAllFrames,
  togetherNow,
  type FrameIds,
} from './frameVerbs.ts';

export interface FrameContext {
  readonly stores: TimelineStores;
  /** The current frame; null: none. */
  readonly id: number | null;
  /** It and those that are selected with it. */
  readonly ids: FrameIds;
}

type FrameAction = Action<FrameContext>;

/** Of the selected frame, or of the one whose card has the focus. */
export function frameContextOf(
  stores: TimelineStores,
  id = stores.view.getState().selectedFrame,
): FrameContext {
  const isThere = id !== null && indexOfFrame(groupOf({ stores }), id) >= 0;
  return isThere ? { stores, id, ids: togetherNow(stores, id) } : { stores, id: null, ids: [] };
}

const groupOf = ({ stores }: Pick<FrameContext, 'stores'>) => stores.document.store.getState().present;

const someFrame = ({ ids }: FrameContext): true | string => ids.length > 0 || words.actions.select;

const oneFrame = (context: FrameContext): true | string =>
  context.ids.length > 1 ? words.actions.onlyOne : someFrame(context);

function sameUnit(context: FrameContext): true | string {
  const { unit } = groupOf(context);
  const isSame = unit === context.stores.device.store.getState().family.unit;
  return isSame || words.actions.otherUnit({ unit: words.units[unit] });
}

/** The pose that would be captured. */
function knownPose({ stores: { device, robots } }: FrameContext): true | string {
  const { known, family } = device.store.getState();
  const tells = tellsPositions(knownFamily(family, robots.current().robot));
  return known.length > 0 || (tells ? words.actions.nothingKnownOrRead : words.actions.nothingKnown);
}

function motion({ stores }: FrameContext): true | string {
  const hindrance = motionHindrance(stores.device.store.getState().snapshot);
  return hindrance === null || words.servos.blocked[hindrance];
}

/** The first reason that there is. */
const all =
  (...conditions: readonly FrameAction['enabled'][]): FrameAction['enabled'] =>
  (context) =>
    conditions.map((condition) => condition(context)).find((one) => one !== true) ?? true;

function load({ stores, id }: FrameContext): void {
  const frame = groupOf({ stores }).frames.find((one) => one.id === id);
  if (frame === undefined) return;
  const targets = frame.targets.map(({ servo, position }) => ({ servo, position }));
  const free = freeOf(stores, targets);
  const staying = stayingOf(stores, targets);
  if (free.length > 0) stores.device.move(free, Math.max(frame.durationMs, GENTLE_MOVE_MS));
  if (staying !== null) stores.notices.show('info', staying);
}

function update({ stores, id }: FrameContext): void {
  if (id === null) return;
  const number = indexOfFrame(groupOf({ stores }), id) + 1;
  stores.document.edit(
    () => words.actions.steps.update({ number }),
    (before) => setTargets(before, id, stores.device.pose()),
  );
}

const insert = (side: 'before' | 'after', icon: FrameAction['icon']): FrameAction => ({
  ...{ id: side, icon, keys: [], enabled: all(oneFrame, knownPose, sameUnit) },
  label: () => words.actions.insert[side],
  run: ({ stores }) => captureFrame(stores, side),
});

const isAmong = ({ ids }: FrameContext, id: number | undefined): boolean => ids.includes(id ?? -1);
const count = (context: FrameContext): number => groupOf(context).frames.length;
const PLACES = {
  earlier: () => -1,
  later: () => 1,
  toStart: (all: number) => -all,
  toEnd: (all: number) => all,
};

export const FRAME_ACTIONS = {
  load: {
    ...{ id: 'load', icon: 'pose', keys: [], enabled: all(oneFrame, sameUnit, motion), run: load },
    label: () => words.actions.load,
  },
  update: {
    ...{ id: 'update', icon: 'update', keys: [], enabled: all(oneFrame, knownPose, sameUnit), run: update },
    label: () => words.actions.update,
  },
  before: insert('before', 'insertBefore'),
  after: insert('after', 'insertAfter'),
  ...cardActions<FrameContext>({
    label: (name) => words.actions[name === 'remove' ? 'delete' : name],
    select: () => words.actions.select,
    isNone: ({ ids }) => ids.length === 0,
    isFirst: (context) => isAmong(context, groupOf(context).frames[0]?.id),
    isLast: (context) => isAmong(context, groupOf(context).frames.at(-1)?.id),
    move(context, to) {
      if (context.id !== null) moveBy(context.stores, context.id, PLACES[to](count(context)));
    },
    remove: ({ stores, ids }) => removeFrames(stores, ids),
  }),
  duplicate: {
    ...{ id: 'duplicate', icon: 'duplicate', keys: ['Ctrl+d'], enabled: someFrame },
    label: () => words.actions.duplicate,
    run: ({ stores, ids }) => duplicate(stores, ids),
  },
  cut: {
    ...{ id: 'cut', icon: 'cut', keys: ['Ctrl+x'], enabled: someFrame },
    label: () => words.actions.cut,
    run: ({ stores, ids }) => void cut(stores, ids),
  },
  copy: {
    ...{ id: 'copy', icon: 'copy', keys: ['Ctrl+c'], enabled: someFrame },
    label: () => words.actions.copy,
    run: ({ stores, ids }) => void copy(stores, ids),
  },
  paste: {
    ...{ id: 'paste', icon: 'paste', keys: ['Ctrl+v'] },
    label: () => words.actions.paste,
    enabled: ({ stores }) => stores.timeline.getState().clip !== null || words.actions.nothingToPaste,
    run: ({ stores }) => paste(stores, stores.timeline.getState().clip),
  },
  selectAll: {
    ...{ id: 'selectAll', icon: 'frames', keys: ['Ctrl+a'] },
    label: () => words.actions.selectAll,
    enabled: (context) => count(context) > 0 || words.actions.empty,
    run(context) {
      const lead = context.id ?? groupOf(context).frames[0]?.id;
      if (lead !== undefined) selectAllFrames(context.stores, lead);
    },
  },
} as const satisfies Readonly<Record<string, FrameAction>>;

const list: readonly FrameAction[] = Object.values(FRAME_ACTIONS);
const SPAN = 'Shift+';

/** Keys of the strip that stand in no menu. */
export const FRAME_KEYS: readonly Pick<KeyUse<never>, 'id' | 'keys' | 'label'>[] = [
  walkKeys(),
  {
    ...{ id: 'span', keys: walkKeys().keys.map((key) => SPAN + key) },
    label: () => words.actions.spanTo,
  },
];

/** Whether the key was one of the strip's own. `id`: the card that has the focus. */
type StripKeys = (pressed: Pressed, id: number) => boolean;

export function createStripKeys(stores: TimelineStores): StripKeys {
  /** What Shift has selected so far: it grows and shrinks at the other end. */
  let span = { from: 0, to: 0 };

  function extend(key: string, id: number): boolean {
    const ids = groupOf({ stores }).frames.map((frame) => frame.id);
    const to = neighbour(key, ids.indexOf(id), ids.length);
    if (to === null) return false;
    const continues = span.to === id && togetherNow(stores, id).includes(span.from);
    span = { from: continues ? span.from : id, to: ids[to] ?? id };
    spanFrames(stores, span.from, span.to);
    return true;
  }

  return (pressed, id) => {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = pressed;
    if (shiftKey && !ctrlKey && !metaKey && !altKey) return extend(key, id);
    return runByKey(list, pressed, frameContextOf(stores, id));
  };
}
