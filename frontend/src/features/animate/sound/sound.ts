// The sound of the open group: its file on this computer, what was heard in it, and its edits, each one step of undo. What the document says
// of it is in the group. Plays nothing and draws nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { type Beats, withTempo } from '#shared/group/beats.ts';
import type { ActionGroup, GroupSound } from '#shared/group/group.ts';
import type { Label } from '#shared/document/history.ts';
import { words } from '../../../i18n/whole.ts';
import { storedFile, storeFile } from '../../../state/fileStore.ts';
import { chooseFile } from '../../../ui/localFiles.tsx';
import type { Stores } from '../../stores.ts';
import type { Heard, Samples } from './soundWorker.ts';

export type SoundStores = Pick<Stores, 'document' | 'notices'>;

/** As the page plays and draws it. */
interface Track extends Heard {
  readonly buffer: AudioBuffer;
  readonly lengthMs: number;
}

export interface SoundState {
  /** `missing`: its file is not on this computer, or cannot be read here. */
  readonly status: 'none' | 'loading' | 'missing' | 'ready';
  readonly track: Track | null;
}

interface Sound {
  readonly store: StoreApi<SoundState>;
  /** With its beats, in the place of the one that is there; says why not. */
  take(file: File): Promise<void>;
  /** The person chooses a file. */
  choose(): Promise<void>;
}

const KINDS = 'audio/*';
const MOST_BYTES = 60_000_000;
const NAME_LENGTH = 255;
/** Whatever a device plays at: a browser converts it. */
const RATE = 44_100;

const all = new WeakMap<SoundStores['document'], Sound>();

/** The one of these stores, made when it is first needed. */
export function soundOf(stores: SoundStores): Sound {
  const made = all.get(stores.document) ?? createSound(stores);
  all.set(stores.document, made);
  return made;
}

const soundIn = ({ document }: Pick<SoundStores, 'document'>): GroupSound | undefined =>
  document.store.getState().present.sound;

function createSound({ document, notices }: SoundStores): Sound {
  const store = createStore<SoundState>(() => NO_SOUND);
  /** Of the file whose track is in the store, or is on its way there. */
  let id: string | null = null;

  async function load(wanted: string): Promise<void> {
    store.setState({ status: 'loading', track: null });
    const track = await readStored(wanted);
    if (id === wanted) store.setState(track === null ? MISSING : { status: 'ready', track });
  }

  function follow(): void {
    const wanted = soundIn({ document })?.id ?? null;
    if (wanted === id) return;
    id = wanted;
    if (wanted === null) store.setState(NO_SOUND);
    else void load(wanted);
  }

  async function take(file: File): Promise<void> {
    const flaw = file.size > MOST_BYTES ? words.sound.tooLarge : await taken(file);
    if (flaw !== null) notices.show('warning', flaw);
  }

  /** Says why not, or null. */
  async function taken(file: File): Promise<string | null> {
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      const track = await readTrack(bytes);
      if (track === null) return words.sound.unreadable({ file: file.name });
      const next = await storeFile(bytes);
      id = next;
      store.setState({ status: 'ready', track });
      // The very file that was missing: the document has it already.
      if (soundIn({ document })?.id === next) return null;
      const fileName = file.name.slice(0, NAME_LENGTH);
      document.edit(
        () => words.sound.steps.add,
        (group) => ({
          ...group,
          sound: { id: next, fileName, startMs: group.sound?.startMs ?? 0, beats: track.beats },
        }),
      );
      return null;
    } catch {
      return words.sound.notStored;
    }
  }

  follow();
  document.store.subscribe(follow);
  return {
    ...{ store, take },
    async choose() {
      const file = await chooseFile(KINDS);
      if (file !== null) await take(file);
    },
  };
}

const NO_SOUND: SoundState = { status: 'none', track: null };
const MISSING: SoundState = { status: 'missing', track: null };

async function readStored(id: string): Promise<Track | null> {
  try {
    const bytes = await storedFile(id);
    return bytes === null ? null : await readTrack(bytes);
  } catch {
    return null;
  }
}

/** null: no sound that this browser can decode. */
async function readTrack(bytes: Uint8Array): Promise<Track | null> {
  let buffer: AudioBuffer;
  try {
    // A copy: decoding takes the bytes away.
    buffer = await new OfflineAudioContext(1, 1, RATE).decodeAudioData(bytes.slice().buffer);
  } catch {
    return null;
  }
  return { ...(await heardIn(buffer)), buffer, lengthMs: buffer.duration * 1000 };
}

function heardIn(buffer: AudioBuffer): Promise<Heard> {
  const samples = oneChannel(buffer);
  const worker = new Worker(new URL('./soundWorker.ts', import.meta.url), { type: 'module' });
  return new Promise<Heard>((resolve, reject) => {
    worker.addEventListener('message', ({ data }: MessageEvent<Heard>) => resolve(data));
    worker.addEventListener('error', () => reject(new Error('the worker beside the page failed')));
    worker.postMessage({ samples, sampleRate: buffer.sampleRate } satisfies Samples, [samples.buffer]);
  }).finally(() => worker.terminate());
}

function oneChannel(buffer: AudioBuffer): Float32Array<ArrayBuffer> {
  const samples = new Float32Array(buffer.length);
  for (let channel = 0; channel < buffer.numberOfChannels; channel += 1) {
    const part = buffer.getChannelData(channel);
    for (let at = 0; at < part.length; at += 1)
      samples[at] = (samples[at] ?? 0) + (part[at] ?? 0) / buffer.numberOfChannels;
  }
  return samples;
}

/** The first file that may be a sound; null: none is. */
export const soundAmong = (files: Iterable<File>): File | null =>
  [...files].find(({ type }) => type.startsWith('audio/')) ?? null;

// Edits of the sound that is there.

export function removeSound({ document }: Pick<SoundStores, 'document'>): void {
  document.edit(
    () => words.sound.steps.remove,
    ({ sound: _, ...group }) => group,
  );
}

export const soundMoved =
  (startMs: number) =>
  (group: ActionGroup): ActionGroup =>
    group.sound === undefined ? group : { ...group, sound: { ...group.sound, startMs } };

export function setBeats(
  { document }: Pick<SoundStores, 'document'>,
  beats: Beats | null,
  label: Label = () => words.sound.steps.beats,
): void {
  document.edit(label, (group) =>
    group.sound === undefined ? group : { ...group, sound: { ...group.sound, beats } },
  );
}

export function changeTempo(stores: Pick<SoundStores, 'document'>, factor: 0.5 | 2): void {
  const beats = soundIn(stores)?.beats ?? null;
  const next = beats === null ? null : withTempo(beats, factor);
  if (next !== null) setBeats(stores, next, () => words.sound.steps.tempo);
}
