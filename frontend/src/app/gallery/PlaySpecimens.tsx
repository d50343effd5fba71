// Compiling and playing a group, the board's slots, and the camera beside the motion, in their states.

import { compileSource } from '../../features/board/compile/compileSource.ts';
import type { ReactNode } from 'react';
import { insertFrame, setMeta, type NewFrame } from '#shared/group/groupEdits.ts';
import { EMPTY_SLOT_BOOK, withStored } from '#shared/group/slotBook.ts';
import { CompileRow } from '../../features/animate/group/CompileRow.tsx';
import { BoardPanel } from '../../features/board/BoardPanel.tsx';
import { PlayBar } from '../../features/animate/play/PlayBar.tsx';
import { type CameraAccess, CameraView } from '../../features/camera/CameraView.tsx';
import { filmOf } from '../../features/camera/film.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import { ReplaceContent } from '../../features/board/slots/ReplaceQuestion.tsx';
import { SlotBoard } from '../../features/board/slots/SlotBoard.tsx';
import { editServoView, type Stores } from '../../features/stores.ts';
import { standing, type Exhibit } from './exhibit.ts';
import styles from './Gallery.module.css';

const frame = (durationMs: number, position: number, easing: 'linear' | 'inOut' = 'linear'): NewFrame => ({
  ...{ durationMs, easing },
  targets: [1, 2, 3].map((servo) => ({ servo, position: position + 100 * servo })),
});

function write({ document, compiled }: Stores, ...frames: readonly NewFrame[]): void {
  document.edit(
    () => 'write',
    (group) =>
      frames.reduce((sum, each) => insertFrame(sum, sum.frames.length, each), { ...group, name: 'Wave' }),
  );
  compiled.now(compileSource);
}

function fill(stores: Stores): void {
  write(stores, frame(400, 900), frame(900, 1900));
  const { frames, fingerprint } = stores.compiled.now(compileSource);
  const stored = {
    name: 'Wave',
    documentId: stores.library.store.getState().openId,
    frames,
    fingerprint,
    storedAtMs: 1_790_000_000_000,
  };
  const book = [
    { ...stored, slot: 0, fingerprint: 'c0ffee00' },
    { ...stored, slot: 1 },
    { ...stored, slot: 8, name: 'Bow', documentId: 'bow', fingerprint: 'beef0000' },
  ].reduce(withStored, EMPTY_SLOT_BOOK);
  stores.slots.store.setState({ book: { ...book, erased: [{ ...stored, slot: 100, name: 'Dance' }] } });
}

interface Case {
  readonly name: string;
  readonly panel: ReactNode;
  readonly isInDialog?: boolean;
  prepare(stores: Stores): void;
}

const CASES: readonly Case[] = [
  {
    name: 'On the board, off by a little',
    panel: <BoardPanel fit={<CompileRow />} />,
    prepare: (stores) => write(stores, frame(400, 900), frame(900, 1900, 'inOut')),
  },
  {
    name: 'On the board, does not fit',
    panel: <BoardPanel fit={<CompileRow />} />,
    prepare: (stores) => write(stores, frame(400, 300), frame(5, 1900), frame(20, 700)),
  },
  {
    name: 'Going to the first pose',
    panel: <PlayBar />,
    prepare: ({ playback }) => playback.store.setState({ phase: 'leading' }),
  },
  {
    name: 'Only on the drawing',
    panel: <PlayBar />,
    prepare: ({ playback }) => playback.store.setState({ phase: 'previewing' }),
  },
  {
    name: 'The board gets the group first',
    panel: <PlayBar />,
    prepare: ({ playback }) => playback.store.setState({ phase: 'storing' }),
  },
  {
    name: 'Ready to play from within',
    panel: <PlayBar />,
    prepare(stores) {
      fill(stores);
      stores.playhead.go(700);
    },
  },
  {
    name: 'Ready to play, a row muted',
    panel: <PlayBar />,
    prepare(stores) {
      fill(stores);
      editServoView(stores, (view) => ({ ...view, muted: [1] }));
    },
  },
  {
    name: 'On the board, another group in the slot',
    panel: <BoardPanel fit={<CompileRow />} />,
    prepare(stores) {
      fill(stores);
      stores.view.setState({ slot: 8 });
    },
  },
  {
    name: 'Download, another group in the slot',
    panel: <AnotherGroupInSlot />,
    isInDialog: true,
    prepare(stores) {
      fill(stores);
      stores.view.setState({ slot: 8 });
    },
  },
  { name: 'Slots', panel: <SlotBoard />, prepare: fill },
  {
    name: 'Slots, several groups',
    panel: <SlotBoard isSeveralFirst />,
    prepare(stores) {
      fill(stores);
      void stores.library.add(
        setMeta(stores.document.store.getState().present, { name: 'Greet the visitor', slot: 12 }),
      );
    },
  },
];

/** A room with a window, as a camera has it. */
function drawn(): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width: 640, height: 480 });
  const pen = canvas.getContext('2d');
  const parts = {
    '#6b7480': [0, 0, 640, 480],
    '#dfe7ee': [360, 50, 200, 150],
    '#3d3a36': [0, 380, 640, 100],
  };
  for (const [colour, [x = 0, y = 0, width = 0, height = 0]] of Object.entries(parts)) {
    if (pen !== null) pen.fillStyle = colour;
    pen?.fillRect(x, y, width, height);
  }
  return canvas;
}

const picture = (): Promise<Blob | null> => new Promise((resolve) => drawn().toBlob(resolve, 'image/jpeg'));

const BENCH: CameraAccess = {
  list: () => Promise.resolve([{ id: 0, name: 'Bench' }]),
  async watch(_id, _signal, show) {
    const shown = await picture();
    if (shown !== null) await show(shown);
    return new Promise(() => undefined);
  },
  openHere: () => Promise.resolve(drawn().captureStream()),
};

const DEAD = 'The camera Bench does not answer: timed out. Check that it is switched on.';

const CAMERAS: Readonly<Record<string, ReactNode>> = {
  'Camera, none': <CameraView access={{ ...BENCH, list: () => Promise.resolve([]) }} />,
  'Camera, of this computer': <CameraView access={BENCH} />,
  'Camera, of the gateway': <CameraView access={BENCH} />,
  'Camera, awaited': <CameraView access={{ ...BENCH, watch: () => new Promise(() => undefined) }} />,
  'Camera, dead': (
    <CameraView
      access={{ ...BENCH, watch: () => Promise.reject(new GatewayProblem('cameraFailed', DEAD)) }}
    />
  ),
  'Film, awaited': <CameraView access={BENCH} />,
  'Film, shown': <CameraView access={BENCH} />,
  'Camera, refused here': (
    <CameraView
      access={{ ...BENCH, openHere: () => Promise.reject(new DOMException('', 'NotAllowedError')) }}
    />
  ),
};

/** Beside the timeline, and with pictures of a motion where there has been one. */
async function film(stores: Stores, isTaken: boolean): Promise<void> {
  const { playback, playhead, view } = stores;
  const taken = filmOf(stores);
  view.setState({ tab: 'actions' });
  taken.set(true);
  if (!isTaken) return;
  playback.store.setState({ phase: 'playing' });
  for (const atMs of [400, 1600]) {
    playhead.go(atMs);
    await taken.take(drawn(), { width: 640, height: 480 });
  }
  playback.store.setState({ phase: null });
}

function AnotherGroupInSlot() {
  const conflict = { slot: 8, record: null, version: undefined, held: 'Bow', heldId: 'bow', name: 'Wave' };
  return <ReplaceContent question={{ conflicts: [conflict], free: [21] }} />;
}

const played: readonly Exhibit[] = CASES.map(({ name, panel, isInDialog = false, prepare }) => ({
  ...{ name, content: panel, isInDialog },
  stores() {
    const stores = standing({});
    prepare(stores);
    return stores;
  },
}));

const seen: readonly Exhibit[] = Object.entries(CAMERAS).map(([name, view]) => ({
  name,
  content: <div className={styles.camera}>{view}</div>,
  stores() {
    const stores = standing({});
    stores.view.setState({ cameraHere: name.endsWith('here') || name.endsWith('computer') });
    if (name.startsWith('Film')) void film(stores, name.endsWith('shown'));
    return stores;
  },
}));

export const PLAYING: readonly Exhibit[] = [...played, ...seen];
