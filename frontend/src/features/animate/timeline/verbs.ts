// The verbs of the timeline by name, each with what it needs: toolbar, menu and keys all lead here.

import type { IconName } from '../../../ui/Icon.tsx';
import type { Ask, TimelineState } from './timeline.ts';
import { words, type Words } from '../../../i18n/whole.ts';
import {
  copy,
  cut,
  duplicate,
  mirrorFrames,
  paste,
  remove,
  removeTime,
  selectAll,
  selectNone,
  setKeys,
  turnRound,
} from './changes.ts';
import type { TimelineContext } from './context.ts';
import { fitAll, fitSelection, goToFrame, goToKey, selectRow, toggleRange, zoom } from './looking.ts';
import { goToMarker } from './markers.ts';

export type VerbName = keyof Words['timeline']['verbs'];

export interface Verb {
  readonly icon: IconName;
  /** What must be selected for it. */
  readonly needs: 'keys' | 'keysOrMarker' | 'nothing';
  /** For the menu; what the keymap knows. */
  readonly keys: string;
  run(context: TimelineContext): void;
}

const asking =
  (question: Ask) =>
  ({ stores }: TimelineContext): void =>
    stores.timeline.setState({ question });

export const VERBS: Readonly<Record<VerbName, Verb>> = {
  setKey: { icon: 'plus', needs: 'nothing', keys: 'Enter', run: setKeys },
  editValue: { icon: 'edit', needs: 'keys', keys: 'F2', run: asking('value') },
  remove: { icon: 'trash', needs: 'keysOrMarker', keys: 'Delete', run: remove },
  removeTime: { icon: 'erase', needs: 'keys', keys: 'Shift+Delete', run: removeTime },
  cut: { icon: 'cut', needs: 'keys', keys: 'Ctrl+x', run: (context) => void cut(context) },
  copy: { icon: 'copy', needs: 'keys', keys: 'Ctrl+c', run: (context) => void copy(context) },
  paste: {
    icon: 'paste',
    needs: 'nothing',
    keys: 'Ctrl+v',
    run: (context) => paste(context, context.state.clip),
  },
  duplicate: { icon: 'duplicate', needs: 'keys', keys: 'Ctrl+d', run: duplicate },
  insertTime: { icon: 'later', needs: 'nothing', keys: 'i', run: asking('insertTime') },
  reverse: { icon: 'reverse', needs: 'keys', keys: 'r', run: turnRound },
  mirror: { icon: 'mirror', needs: 'keys', keys: 'x', run: mirrorFrames },
  scaleTime: { icon: 'tune', needs: 'keys', keys: 's', run: asking('scaleTime') },
  scaleTimeBack: { icon: 'tune', needs: 'keys', keys: 'Shift+s', run: asking('scaleTimeBack') },
  scaleAmplitude: { icon: 'tune', needs: 'keys', keys: 'a', run: asking('scaleAmplitude') },
  note: { icon: 'edit', needs: 'keys', keys: 'n', run: asking('note') },
  marker: { icon: 'marker', needs: 'nothing', keys: 'm', run: asking('marker') },
  nextMarker: { icon: 'marker', needs: 'nothing', keys: 'Shift+m', run: goToMarker },
  selectAll: { icon: 'frames', needs: 'nothing', keys: 'Ctrl+a', run: selectAll },
  selectRow: {
    icon: 'frames',
    needs: 'nothing',
    keys: 'Shift+a',
    run: (context) => selectRow(context, context.state.cursor.row, 'toggles'),
  },
  selectNone: { icon: 'close', needs: 'nothing', keys: 'Ctrl+Shift+a', run: selectNone },
  zoomIn: { icon: 'plus', needs: 'nothing', keys: '+', run: (context) => zoom(context, 1) },
  zoomOut: { icon: 'minus', needs: 'nothing', keys: '-', run: (context) => zoom(context, -1) },
  fitAll: { icon: 'fit', needs: 'nothing', keys: 'f', run: fitAll },
  fitSelection: { icon: 'fit', needs: 'keys', keys: 'Shift+f', run: fitSelection },
  range: { icon: 'refresh', needs: 'nothing', keys: 'l', run: toggleRange },
  frameBefore: { icon: 'earlier', needs: 'nothing', keys: ',', run: (context) => goToFrame(context, -1) },
  frameAfter: { icon: 'later', needs: 'nothing', keys: '.', run: (context) => goToFrame(context, 1) },
  keyBefore: { icon: 'earlier', needs: 'nothing', keys: 'j', run: (context) => goToKey(context, -1) },
  keyAfter: { icon: 'later', needs: 'nothing', keys: 'k', run: (context) => goToKey(context, 1) },
};

type Marked = Pick<TimelineState, 'marker'>;

/** Some mean a marker where one is selected. */
export function verbName(name: VerbName, { marker }: Marked): string {
  const { verbs, ...others } = words.timeline;
  const markerVerbs: Readonly<Partial<Record<VerbName, string>>> = others.markerVerbs;
  return (marker === null ? undefined : markerVerbs[name]) ?? verbs[name];
}

export function mayRun(
  { state }: { readonly state: Pick<TimelineState, 'selected' | 'marker'> },
  { needs }: Verb,
): boolean {
  const hasKeys = state.selected.size > 0;
  return needs === 'nothing' || hasKeys || (needs === 'keysOrMarker' && state.marker !== null);
}
